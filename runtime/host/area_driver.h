#pragma once

// Adapts the I/O areas of the cell, for which the driver was wired, to those of a program, which may be
// smaller. Inputs beyond the program's are ignored; every write drives all outputs of the cell, and those
// beyond the program's stay in the safe state that rest_outputs or a longer write gave them.
//
// Threads: the scan thread. Memory is taken once.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/image/io_driver.h"

namespace stepwright::host {

class AreaDriver final : public image::IoDriver {
 public:
  // The driver must outlive this one.
  AreaDriver(image::IoDriver& driver, std::size_t input_bytes, std::size_t output_bytes)
      : driver_(driver), inputs_(input_bytes), outputs_(output_bytes) {}

  // Requires areas no larger than the cell's.
  image::IoStatus read_inputs(std::int64_t now_ns, std::span<std::byte> inputs) override;
  image::IoStatus write_outputs(std::int64_t now_ns, std::span<const std::byte> outputs) override;

  bool takes_over() override;
  void safe(std::uint8_t cause, bool settled) override { driver_.safe(cause, settled); }
  void rest_outputs(std::span<const std::byte> rest) override;
  bool lapsed() override { return driver_.lapsed(); }
  void release_outputs() override { driver_.release_outputs(); }
  void beat() override { driver_.beat(); }
  std::uint64_t held_reads() const override { return driver_.held_reads(); }

  // The outputs as last written; before the first write, and after a takeover, as the one before left them,
  // else zero.
  std::span<const std::byte> outputs();

  std::size_t input_bytes() const { return inputs_.size(); }
  std::size_t output_bytes() const { return outputs_.size(); }

  // The inputs of the newest read, and the driver's answers to it and to the writes since.
  std::span<const std::byte> inputs() const { return inputs_; }
  bool read_good() const { return read_good_; }
  bool write_good() const { return write_good_; }

 private:
  image::IoDriver& driver_;
  std::vector<std::byte> inputs_;
  std::vector<std::byte> outputs_;
  bool written_ = false;
  bool read_good_ = true;
  bool write_good_ = true;
};

}  // namespace stepwright::host

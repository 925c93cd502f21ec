#pragma once

// The newest event: a start, a stop, a trap or a change of step bits, with the image after it.
// Called by the main loop only. No heap: the image's copy lies in memory of the caller.

#include <cstdint>
#include <span>

#include "runtime/bytecode/program.h"
#include "runtime/modbus/control/registers.h"

namespace stepwright::app {

class Events {
 public:
  // Where copies of the image go from now on; it has the size of the image, and becomes a copy of it. The
  // newest event's copy is gone.
  void use(std::span<std::byte> copy, std::span<const std::byte> image);

  void record(modbus::control::Event kind, std::uint64_t scan, std::span<const std::byte> image);

  // True if a step bit differs from what it was after the newest event. Every change is an event, so that is
  // the scan before.
  bool steps_changed(const bytecode::Program& program, std::span<const std::byte> image) const;

  std::uint32_t number() const { return number_; }  // of the newest; 0 = none yet
  modbus::control::Event kind() const { return kind_; }
  std::uint64_t scan() const { return scan_; }  // after which it happened
  std::span<const std::byte> image() const { return copy_; }

 private:
  std::span<std::byte> copy_;
  std::uint32_t number_ = 0;
  modbus::control::Event kind_ = modbus::control::Event::Started;
  std::uint64_t scan_ = 0;
};

}  // namespace stepwright::app

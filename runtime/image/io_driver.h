#pragma once

// Interface of the I/O driver behind %I and %Q: a simulated plant, shared memory, a test.
//
// Thread rule: the scan thread calls it, but for what says otherwise; no heap, lock, exception or log inside.

#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::image {

enum class IoStatus : std::uint8_t {
  Good,  // every channel is fresh
  Lost,  // the device does not answer; outputs go to their safe state
};

// Both areas are the raw bytes of the process image: bit b of byte n is %IXn.b / %QXn.b; words are
// little-endian at bytes 2n and 2n+1 of the area (%IWn).
class IoDriver {
 public:
  virtual ~IoDriver() = default;

  // Called at the start of a scan at `now_ns` of the scan's clock (starts at 0).
  virtual IoStatus read_inputs(std::int64_t now_ns, std::span<std::byte> inputs) = 0;

  // Called at the end of a scan with the outputs that hold from `now_ns` on. A program may have fewer than
  // there are: the rest stays as rest_outputs, or a longer write, left it.
  virtual IoStatus write_outputs(std::int64_t now_ns, std::span<const std::byte> outputs) = 0;

  // Asks for the outputs where somebody else may drive them, before safe ones are written. True if this call
  // has got them: they are as the other one left them. Scan thread.
  virtual bool takes_over() { return false; }

  // The outputs as whoever drove them last left them, before the first write; false where nobody knows.
  virtual bool left_outputs(std::span<std::byte>) { return false; }

  // The outputs of the next write are safe ones, for this cause (scan::SafeCause); settled: they stay as they
  // are. Scan thread.
  virtual void safe(std::uint8_t, bool) {}

  // Outputs behind those of the next writes, which the program lacks, in their safe state. For drivers with
  // more outputs than the program.
  virtual void rest_outputs(std::span<const std::byte>) {}

  // This process stood still for so long that others took it for lost and made its outputs safe. Until the
  // next safe ones nothing is written. Scan thread.
  virtual bool lapsed() { return false; }

  // The end of driving: the outputs stay as the newest write left them. The last call but for the destructor;
  // before the process waits for anything at its end. Scan thread.
  virtual void release_outputs() {}

  // The scan is alive. Called now and then by a thread beside the scan's, with the same rules.
  virtual void beat() {}

  // Reads so far that left the inputs of the one before, because no whole ones could be had in time. Any
  // thread.
  virtual std::uint64_t held_reads() const { return 0; }
};

}  // namespace stepwright::image

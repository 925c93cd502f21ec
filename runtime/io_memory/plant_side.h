#pragma once

// The plant's side of a shared-memory I/O area: a simulator, a bus master, a test. Other languages do the
// same after runtime/doc/shared_memory_io.md.
//
//   auto plant = PlantSide::open("press", 64, 64);
//   (*plant)->announce(100'000'000);                 // from now on silent for 100 ms at most
//   while (...) { (*plant)->write_inputs(inputs); (*plant)->read_outputs(outputs); }
//
// Threads: one. No heap, lock or system call but in open. Fails as IoArea::open, and with R0044 if another
// plant is attached.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "runtime/io_memory/io_area.h"

namespace stepwright::io_memory {

struct OutputStamp {
  std::uint64_t generation = 0;  // of the lease under which they were written
  std::int64_t time_ns = 0;
};

class PlantSide {
 public:
  [[nodiscard]] static result::Result<std::unique_ptr<PlantSide>> open(const std::string& name,
                                                                       std::uint32_t input_bytes,
                                                                       std::uint32_t output_bytes);

  // From now on the runtime takes the plant for lost when it is silent for longer; 0: it never does. One that
  // is not alive is lost from the beginning, until the next beat or write_inputs.
  void announce(std::int64_t timeout_ns, bool alive = true);
  // The plant is alive although no input has changed.
  void beat();
  void write_inputs(std::span<const std::byte> inputs);
  // This process is alive, what it stands for is not: the runtime takes the plant for lost at once, until the
  // next beat or write_inputs. The inputs are what is left to know.
  void lose(std::span<const std::byte> inputs);

  // The newest outputs; none before the first.
  std::optional<OutputStamp> read_outputs(std::span<std::byte> outputs);
  Owner owner();
  // No ramp of safe outputs is on its way.
  bool settled() const;
  // How long the holder of the lease has not been heard of, in ns. Of use while the owner is Runtime or
  // Guard.
  std::int64_t holder_silence_ns();

 private:
  explicit PlantSide(std::unique_ptr<IoArea> area) : area_(std::move(area)) {}
  std::unique_ptr<IoArea> area_;
};

}  // namespace stepwright::io_memory

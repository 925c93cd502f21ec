#pragma once

// I/O over a shared-memory area: the plant is another process, and the outputs stay when this one is killed,
// for the guard to drive.
//
// The driver takes the lease with its first write: until a guard that drives has given way it writes nothing
// (a few milliseconds; after a second the I/O counts as lost). From then on it alone writes.
//
// Threads: the scan thread; beat by any one other. A scan takes no heap, lock or system call, but one system
// call while the lease is being taken. Invariants: outputs are written under the lease only; inputs are those
// of one write of the plant, whole, or stay as they were (held, and counted); Lost when the plant announced
// how long it may be silent and is silent for longer, or when inputs had to be held for longer than that (100
// ms if it announced nothing).

#include <atomic>
#include <cstdint>
#include <memory>

#include "runtime/image/io_driver.h"
#include "runtime/io_memory/input_age.h"
#include "runtime/io_memory/io_area.h"

namespace stepwright::io_memory {

// Whether a plant that has announced nothing, or was never there, is one.
enum class PlantNeed : std::uint8_t {
  Announced,  // only a plant that has announced how long it may be silent can be lost
  Always,     // without one the I/O is lost
};

class MemoryDriver final : public image::IoDriver {
 public:
  explicit MemoryDriver(std::unique_ptr<IoArea> area, PlantNeed need = PlantNeed::Announced)
      : area_(std::move(area)), need_(need) {}
  // Says farewell: nobody drives the outputs any more, and the guard leaves them alone.
  ~MemoryDriver() override;

  // Requires the sizes of the area.
  image::IoStatus read_inputs(std::int64_t now_ns, std::span<std::byte> inputs) override;
  image::IoStatus write_outputs(std::int64_t now_ns, std::span<const std::byte> outputs) override;
  bool left_outputs(std::span<std::byte> outputs) override;
  void safe(std::uint8_t cause, bool settled) override;
  void beat() override;

  // A guard watches this area, and not one that is about to end because the last runtime said farewell.
  bool guarded() const;
  // The plant is heard of, as far as it must be. Any thread.
  bool plant_alive() const;
  // The plant was faster than every attempt to read them.
  std::uint64_t held_reads() const override { return age_.held_reads(); }

 private:
  bool take_lease(std::int64_t now_ns);
  bool read_in_time(std::span<std::byte> inputs);
  std::int64_t plant_timeout_ns() const;

  std::unique_ptr<IoArea> area_;
  PlantNeed need_;
  std::atomic<bool> leased_{false};
  std::uint64_t generation_ = 0;
  std::int64_t wanted_since_ns_ = 0;
  InputAge age_;
};

}  // namespace stepwright::io_memory

#pragma once

// I/O over a shared-memory area: the plant is another process, and the outputs stay when this one is killed,
// for the guard to drive.
//
// The driver takes the lease with its first write, or before it (takes_over): until a guard that drives has
// given way it writes nothing (a few milliseconds; after a second the I/O counts as lost). From then on it
// alone writes.
//
// A heartbeat that was older than `judged_after` made others drive the safe outputs, if there are others:
// from then on nothing is written and no heartbeat is given until the outputs are safe ones here, too
// (lapsed). Then it goes on: what others have made safe never comes back by itself.
//
// Threads: the scan thread; beat by any one other. A scan takes no heap, lock or system call, but one system
// call while the lease is being taken. Invariants: outputs are written under the lease only; inputs are those
// of one write of the plant, whole, or stay as they were (held, and counted); Lost when the plant announced
// how long it may be silent and is silent for longer, or when inputs had to be held for longer than that (100
// ms if it announced nothing), or while another runtime drives the outputs.

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "runtime/image/io_driver.h"
#include "runtime/io_memory/input_age.h"
#include "runtime/io_memory/io_area.h"
#include "runtime/io_memory/process_mark.h"

namespace stepwright::io_memory {

// Whether a plant that has announced nothing, or was never there, is one.
enum class PlantNeed : std::uint8_t {
  Announced,  // only a plant that has announced how long it may be silent can be lost
  Always,     // without one the I/O is lost
};

// When others take a silent runtime for lost.
struct Judgement {
  std::int64_t after_ns = 0;  // how old the heartbeat may be; 0: nobody does, as in simulated time
  bool always = false;        // also while no guard watches: a bus master with a safe state of its own, say
};

struct GuardFigures {
  bool there = false;
  std::int64_t silent_ns = 0;  // how long it has not been heard of
  ProcessMark process;
};

class MemoryDriver final : public image::IoDriver {
 public:
  explicit MemoryDriver(std::unique_ptr<IoArea> area, PlantNeed need = PlantNeed::Announced,
                        const Judgement& judgement = {})
      : area_(std::move(area)), need_(need), judgement_(judgement) {}
  // Releases the outputs, unless that was done.
  ~MemoryDriver() override;

  // Requires the sizes of the area.
  image::IoStatus read_inputs(std::int64_t now_ns, std::span<std::byte> inputs) override;
  image::IoStatus write_outputs(std::int64_t now_ns, std::span<const std::byte> outputs) override;
  bool takes_over() override {
    return !left_ && !leased_.load(std::memory_order_relaxed) && take_lease(monotonic_ns());
  }
  bool left_outputs(std::span<std::byte> outputs) override;
  void safe(std::uint8_t cause, bool settled) override;
  bool lapsed() override;
  // The guard leaves the outputs alone, or brings what is not settled to its end.
  void release_outputs() override;
  void beat() override;

  // A guard watches this area, and not one that is about to end because the last runtime released the
  // outputs.
  bool guarded() const;
  // The guard that is there, whoever started it. Any thread; a system call.
  GuardFigures guard() const;
  // The plant is heard of, as far as it must be. Any thread.
  bool plant_alive() const;
  // A runtime other than this one that drives the outputs. Any thread; a system call while this one does not.
  std::optional<ProcessMark> other_runtime() const;
  // The plant was faster than every attempt to read them.
  std::uint64_t held_reads() const override { return age_.held_reads(); }

 private:
  bool take_lease(std::int64_t now_ns);
  bool read_in_time(std::span<std::byte> inputs);
  std::int64_t plant_timeout_ns() const;
  bool overdue(std::int64_t now_ns) const;
  void give_heartbeat(std::int64_t now_ns);

  std::unique_ptr<IoArea> area_;
  const ProcessMark self_ = ProcessMark::own();
  PlantNeed need_;
  Judgement judgement_;
  std::atomic<bool> leased_{false};
  std::atomic<bool> lapsed_{false};  // no heartbeat until safe outputs are written
  bool safe_ = false;                // those of the next write
  bool left_ = false;                // the outputs were released
  std::uint64_t generation_ = 0;
  std::int64_t wanted_since_ns_ = 0;
  InputAge age_;
};

}  // namespace stepwright::io_memory

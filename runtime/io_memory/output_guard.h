#pragma once

// The guard of a shared-memory I/O area: detects that the runtime that drives the outputs is lost, makes sure
// that it writes no more, and drives them to their safe state until a runtime takes them over again.
//
// Lost is a runtime that is gone and did not release them (seen at once, through its process descriptor) and
// one whose heartbeat is too old: stopped, deadlocked, blocked in a driver. That one is killed first. The
// guard writes only while it holds the lease, which it can have only when no thread of the runtime is left:
// there are never two writers.
//
//   auto guard = OutputGuard::create("press", 64, 64, matrix, {});
//   while (going) if (const char* news = (*guard)->turn(stop_descriptor)) log(news);
//
// Threads: one. A turn waits for a tick at most, and takes no heap but to find a runtime of another PID
// namespace. Fails as IoArea::open, and with R0045 if another guard watches the area.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runtime/io_memory/io_area.h"
#include "runtime/scan/safe_state.h"

namespace stepwright::io_memory {

// Another guard watches the area: whoever stands by waits for its end.
inline constexpr const char* kGuardedAlready = "R0045";

struct GuardOptions {
  std::int64_t timeout_ns = 50'000'000;  // how old the runtime's heartbeat may be
  std::int64_t tick_ns = 5'000'000;      // how often the guard looks, and drives
};

enum class GuardState : std::uint8_t {
  Waiting,   // nobody drives
  Watching,  // a runtime drives
  Driving,   // the guard drives
  Helpless,  // a runtime is lost, but cannot be killed (another user's, or of a PID namespace that this
             // process does not see): nothing can be done
};

class OutputGuard {
 public:
  // The data of the matrix must outlive the guard.
  [[nodiscard]] static result::Result<std::unique_ptr<OutputGuard>> create(const std::string& area,
                                                                           std::uint32_t input_bytes,
                                                                           std::uint32_t output_bytes,
                                                                           const scan::SafeMatrix& matrix,
                                                                           const GuardOptions& options);
  // The outputs stay as they are.
  ~OutputGuard();
  OutputGuard(const OutputGuard&) = delete;
  OutputGuard& operator=(const OutputGuard&) = delete;

  // Looks, drives, and waits for the next tick or until `stop` is readable. What is new, or null.
  const char* turn(int stop);

  GuardState state() const { return state_; }
  // True while no process has to drive the outputs: there was no runtime yet, or the last one ended in good
  // order and its outputs are final.
  bool idle() const;

 private:
  OutputGuard(std::unique_ptr<IoArea> area, const scan::SafeMatrix& matrix, const GuardOptions& options);

  const char* look(std::int64_t now_ns);
  const char* wait_for_owner(std::int64_t now_ns);
  const char* watch(std::int64_t now_ns);
  const char* drive(std::int64_t now_ns);
  const char* begin_driving(scan::SafeCause cause, std::int64_t now_ns);
  const char* fence();
  bool process_ended(int timeout_ms) const;
  void forget_process();
  Owner owner() const { return static_cast<Owner>(area_->header().owner.load(std::memory_order_acquire)); }

  std::unique_ptr<IoArea> area_;
  GuardOptions options_;
  std::vector<std::byte> outputs_;
  std::vector<std::byte> memory_;
  scan::SafeState safe_;
  GuardState state_ = GuardState::Waiting;
  int process_ = -1;                 // descriptor of the runtime that is watched; -1: none, or not visible
  std::uint64_t generation_ = 0;     // of the lease that is watched or held
  std::int64_t looked_ns_ = 0;       // when it looked last
  std::int64_t awake_since_ns_ = 0;  // before that the guard itself was kept from looking
  std::int64_t gave_way_ns_ = 0;     // to a runtime that wants the lease; 0: it did not
};

}  // namespace stepwright::io_memory

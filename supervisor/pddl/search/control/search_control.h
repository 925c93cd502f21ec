#pragma once

// Control of all searches of one call, on however many threads they run: when to stop, and the best plan so
// far. The memory budget limits the growth of the process since construction: tables that searches report
// count at once, all else a few milliseconds later.
//
// Thread rule: thread-safe. `on_improvement` is called under a lock, one call at a time, from the thread that
// found the plan; `on_second` from the thread that made the control.
//
//   MemoryShare memory(control);   memory.set(table.memory());
//   if ((reason = control.check()) != StopReason::None) return SearchStatus::Stopped;

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "supervisor/pddl/definition/numeric.h"
#include "supervisor/pddl/ground_task/interval.h"

namespace stepwright::pddl {

enum class StopReason : std::uint8_t { None, Time, Memory, States, Cancelled, Finished };
enum class SearchStatus : std::uint8_t { Running, Found, Exhausted, Stopped };

// Quality of a plan: cost first, then steps. Costs that differ by rounding only count as equal.
struct Quality {
  double cost = kInfinity;
  std::uint32_t steps = UINT32_MAX;

  bool found() const { return steps != UINT32_MAX; }
  // Could a plan of at least that cost and, if it costs as much, at least so many steps be better?
  bool leaves_room_for(double cost_bound, double steps_bound) const {
    return !found() || cost_bound < cost || (cost_bound == cost && steps_bound < static_cast<double>(steps));
  }
};

// A plan of the search; its cost is the accumulated one with the potential.
struct Incumbent {
  std::vector<int> operators;
  Quality quality;
};

class SearchControl {
 public:
  using Clock = std::chrono::steady_clock;

  // `most_states`: that may be expanded; 0: any number.
  SearchControl(std::chrono::milliseconds time, std::size_t memory_mb, const std::atomic<bool>* cancel,
                std::uint64_t most_states = 0);

  // Asks the clock, the flags and the memory in use; cheap enough for every tenth expansion. Once there is a
  // reason to stop, it stays.
  StopReason check();

  // Has the budget ended, or was the search cancelled? Also after `finish`.
  bool used_up();

  // Whether the budget allows for so many bytes more; for what cannot be stopped half-way.
  bool has_room_for(std::size_t bytes) const;
  // Bytes that the process has grown by since this control was made.
  std::size_t grown() const;
  void run_out_of_memory() { stop(StopReason::Memory); }

  // Tells the other threads that nothing is left to do.
  void finish() { stop(StopReason::Finished); }

  double elapsed_ms() const;

  // Takes the plan if it is better than the best so far. One that is too long for the memory budget ends all.
  bool offer(std::vector<int> operators, double cost);

  Incumbent best() const;
  // Changes whenever the best plan does.
  std::uint64_t version() const { return version_.load(std::memory_order_acquire); }

  // No plan that is still to be found costs less; bounds only rise. Of the accumulated cost with the
  // potential.
  void raise_bound(double bound);
  double bound() const { return bound_.load(std::memory_order_relaxed); }

  void count_expanded(std::uint64_t states) { expanded_.fetch_add(states, std::memory_order_relaxed); }
  std::uint64_t expanded() const { return expanded_.load(std::memory_order_relaxed); }
  double peak_mb() const;
  std::size_t memory_limit() const { return memory_limit_; }  // bytes; SIZE_MAX: none

  std::function<void(const Incumbent&)> on_improvement;
  std::function<void(const Incumbent&, double bound)> on_second;  // about once a second

 private:
  friend class MemoryShare;

  StopReason stop(StopReason reason);
  StopReason ended(Clock::time_point now);
  bool memory_used_up(Clock::time_point now);

  const std::thread::id owner_;
  const Clock::time_point start_;
  Clock::time_point next_report_;  // the owner's
  const std::chrono::milliseconds time_;
  const std::size_t memory_limit_;
  const std::uint64_t most_states_;
  const std::size_t resident_before_;
  std::atomic<Clock::rep> next_look_;  // at what the process holds, on the clock of Clock
  const std::atomic<bool>* cancel_;
  std::atomic<StopReason> stopped_{StopReason::None};
  std::atomic<std::size_t> memory_{0};
  std::atomic<std::size_t> peak_{0};
  std::atomic<std::uint64_t> expanded_{0};
  std::atomic<double> bound_{-kInfinity};
  std::atomic<std::uint64_t> version_{0};
  mutable std::mutex mutex_;
  Incumbent best_;  // guarded by mutex_
};

// The bytes that one search holds; released by the destructor.
class MemoryShare {
 public:
  explicit MemoryShare(SearchControl& control) : control_(control) {}
  MemoryShare(const MemoryShare&) = delete;
  MemoryShare& operator=(const MemoryShare&) = delete;
  ~MemoryShare() { set(0); }

  void set(std::size_t bytes);
  std::size_t bytes() const { return bytes_; }

 private:
  SearchControl& control_;
  std::size_t bytes_ = 0;
};

// The quality of the best plan as one thread sees it: asks for it only when it has changed.
class BestKnown {
 public:
  explicit BestKnown(const SearchControl& control) : control_(control) {}

  const Quality& operator()() {
    const std::uint64_t version = control_.version();
    if (version != seen_) {
      seen_ = version;
      quality_ = control_.best().quality;
    }
    return quality_;
  }

 private:
  const SearchControl& control_;
  std::uint64_t seen_ = 0;
  Quality quality_;
};

// Costs are compared after rounding, so that sums in another order are equal.
inline double comparable(double cost) {
  return snap(cost);
}

}  // namespace stepwright::pddl

#pragma once

// Interrupt of a run from outside, for a program that does not come to an end. An engine that is given an
// Interrupt hands out the budget of a run in slices and looks here between two of them, which costs the loops
// of a program nothing; if it is asked to end, the run traps as if its budget were used up
// (TrapCode::Watchdog). A run has a number while it lasts, so that whoever finds a run too long ends that one
// and never the next.
//
// Threads: begin and end by the thread that runs the engine, ask by any other. No lock.
//
//   const std::uint32_t run = interrupt.running();    // outside
//   if (run != 0 && it_takes_too_long()) interrupt.ask(run);

#include <atomic>
#include <cstdint>

namespace stepwright::bytecode {

// In units of the budget (Engine): some 10 us of simple code.
inline constexpr std::uint64_t kBudgetSlice = 1u << 16;

class Interrupt {
 public:
  void begin() {
    if (++last_ == 0) last_ = 1;
    state_.store(last_ * 2, std::memory_order_release);
  }
  void end() { state_.store(0, std::memory_order_release); }

  // The number of the run that is under way and not asked to end; 0: none.
  std::uint32_t running() const {
    const std::uint32_t state = state_.load(std::memory_order_acquire);
    return state % 2 == 0 ? state : 0;
  }
  // True if that run still lasted: it ends at its next look.
  bool ask(std::uint32_t run) { return state_.compare_exchange_strong(run, run | 1u); }

  bool asked() const { return state_.load(std::memory_order_relaxed) % 2 != 0; }

 private:
  std::atomic<std::uint32_t> state_{0};  // twice the number of the run; odd: it is to end; 0: no run
  std::uint32_t last_ = 0;
};

// A budget in slices.
struct BudgetSlices {
  std::uint64_t reserve = 0;  // beyond the slice that is being used
  const Interrupt* interrupt = nullptr;

  // The first slice; the whole budget if nobody may interrupt.
  static constexpr std::uint64_t first(std::uint64_t budget, const Interrupt* interrupt) {
    return interrupt == nullptr || budget < kBudgetSlice ? budget : kBudgetSlice;
  }
  // The remaining budget once there is enough for `cost`; unchanged if there is no more, or the run is to
  // end.
  [[gnu::cold, gnu::noinline]] std::uint64_t refill(std::uint64_t left, std::uint64_t cost) {
    if (interrupt != nullptr && interrupt->asked()) return left;
    const std::uint64_t wanted = cost > kBudgetSlice ? cost : kBudgetSlice;
    const std::uint64_t more = wanted < reserve ? wanted : reserve;
    reserve -= more;
    return left + more;
  }
  // After an operation that may have used the reserve as well: what is left of the slice.
  std::uint64_t after(std::uint64_t slice, std::uint64_t left_of_all) {
    const std::uint64_t used = slice + reserve - left_of_all;
    const std::uint64_t of_slice = used < slice ? used : slice;
    reserve -= used - of_slice;
    return slice - of_slice;
  }
};

}  // namespace stepwright::bytecode

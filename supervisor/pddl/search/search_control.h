#pragma once

// When to stop and what has been found: what all searches of one call share.
//
// Thread rule: one call, one object, one thread (only the cancel flag is set from others).

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <vector>

#include "supervisor/pddl/search/node_store.h"

namespace stepwright::pddl {

enum class StopReason : std::uint8_t { None, Time, Memory, Cancelled };

// A plan of the search: the operators, the accumulated cost with the potential, the number of steps.
struct Incumbent {
  std::vector<int> operators;
  double cost = kInfinity;
  std::uint32_t steps = UINT32_MAX;

  // Lexicographic: cost first. Costs that differ by rounding only count as equal.
  bool beats(double other_cost, std::uint32_t other_steps) const {
    return cost < other_cost || (cost == other_cost && steps < other_steps);
  }
};

class SearchControl {
 public:
  using Clock = std::chrono::steady_clock;

  SearchControl(std::chrono::milliseconds time, std::size_t memory_mb, const std::atomic<bool>* cancel);

  // Asks the clock and the flag; cheap enough for every hundredth expansion. `memory`: bytes in use now.
  StopReason check(std::size_t memory);

  double elapsed_ms() const;

  // Takes the plan if it is better than the best so far.
  bool offer(std::vector<int> operators, double cost, std::uint32_t steps);

  const Incumbent& best() const { return best_; }

  std::function<void()> on_improvement;
  std::function<void(double bound)> on_second;  // about once a second
  std::uint64_t expanded = 0;
  double peak_mb = 0.0;
  double bound = -kInfinity;     // of the accumulated cost with the potential
  std::size_t other_memory = 0;  // bytes that suspended searches hold

 private:
  Clock::time_point start_;
  Clock::time_point next_report_;
  std::chrono::milliseconds time_;
  std::size_t memory_mb_;
  const std::atomic<bool>* cancel_;
  Incumbent best_;
};

// Costs are compared after rounding, so that sums in another order are equal.
inline double comparable(double cost) {
  return snap(cost);
}

}  // namespace stepwright::pddl

#pragma once

// Shorter plans after a first one, in rounds: in each, two Shorteners make something of the shortest plan so
// far, each with a seed of its own that follows from the number of the round, and the shorter one of both is
// where the next round begins (of equal ones that of the first; without an automaton each goes on from its
// own). So the plans are the same on one thread,
// which does both one after the other, and on two. Time cuts whole rounds: of one that was begun nothing is
// taken, so that a slower machine ends earlier in the same row of plans.
//
// Threads: it starts and joins one of its own. Example:
//   const auto plans = shorter_plans(ground, states_of_a_thread, {.start = state, .than_m = 80.0}, 2);

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "supervisor/ltl/search/shortener.h"

namespace stepwright::ltl {

struct ShorterOptions {
  TrainState start{};
  double than_m = std::numeric_limits<double>::infinity();
  const DrivenRoute* first = nullptr;  // of the plan that there is, of an automaton's states; may be null
  std::uint64_t seed = 1;
  double most_s = 1.0;
  std::size_t most_rounds = std::numeric_limits<std::size_t>::max();
  std::size_t threads = 1;
  const std::atomic<bool>* cancel = nullptr;  // not owned; may be null
};

// Each shorter than the one before, the first one than `than_m`; none is judged yet. `states` is asked by the
// thread that uses them.
std::vector<TrainPlan> shorter_plans(const SearchGround& ground, const std::function<TaskStates()>& states,
                                     const ShorterOptions& options);

}  // namespace stepwright::ltl

#pragma once

// The checkers of a problem: spheres, with the pairs of links that they judge wrongly by bodies; and bodies.
//
//   const auto pairs = pairs_of(model, problem);
//   const auto checkers = ArmCheckers::make(model, problem, pairs);
//   const FreeSpace fast = checkers->fast(), careful = checkers->careful();      // look at the checkers
//   plan_certain_path(fast, *exact, space, from, {goal}, {}, {.careful = &careful});
//
// Does not change after it was made; any thread. The pairs are the same for all problems of a robot that move
// the same joints while the others rest alike.

#include <optional>

#include "supervisor/motion/path/free_space.h"
#include "supervisor/motion/problem/arm_problem.h"

namespace stepwright::motion {

FalsePairs pairs_of(const ArmModel& model, const ArmProblem& problem);

class ArmCheckers {
 public:
  // Fails with A0301 and A0302.
  [[nodiscard]] static result::Result<ArmCheckers> make(const ArmModel& model, const ArmProblem& problem,
                                                        const FalsePairs& pairs);

  // Without such pairs, which are left to the judgement of paths as a whole; and with their bodies.
  FreeSpace fast() const { return by_spheres(lean_ ? *lean_ : all_); }
  FreeSpace careful() const { return lean_ ? by_spheres(all_, *lean_, *pairs_) : by_spheres(all_); }

 private:
  CollisionChecker all_;
  std::optional<CollisionChecker> lean_;  // where there are such pairs
  std::optional<ExactChecker> pairs_;
};

}  // namespace stepwright::motion

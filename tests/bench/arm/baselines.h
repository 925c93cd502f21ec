#pragma once

// OMPL's RRTConnect on the same problems: with the same spheres, one place after the other as OMPL's own
// motions are checked, and with our motions of many places at once; its range swept and the best one kept;
// and with FCL on the bodies.

#include <functional>
#include <optional>
#include <vector>

#include "supervisor/motion/problem/arm_checkers.h"
#include "supervisor/motion/recheck/exact_checker.h"
#include "tests/bench/arm/problem_sets.h"

namespace stepwright::bench {

struct BaselineFigures {
  double range = 0.0;  // the best one; 0: as OMPL chooses
  std::size_t solved = 0, asked = 0;
  std::vector<double> solve_ms;  // of the processor, of those solved
};

// Of problems whose ends spheres allow.
BaselineFigures ompl_on_spheres(const ProblemSet& set, const std::vector<std::size_t>& numbers,
                                bool whole_motions, double seconds);
BaselineFigures ompl_on_bodies(const ProblemSet& set, const std::vector<std::size_t>& numbers,
                               double seconds);

double processor_ms(const std::function<void()>& work);
motion::ArmCheckers fast_checkers(const ProblemSet& set, const motion::ArmProblem& problem);

// Checkers of the problems of one set, which share the trees of the robot's meshes. Requires that all move
// the same joints.
class ExactCheckers {
 public:
  explicit ExactCheckers(const ProblemSet& set);
  motion::ExactChecker of(const motion::ArmProblem& problem, bool with_spheres);

 private:
  const ProblemSet& set_;
  std::optional<motion::ExactChecker> quick_, plain_;
};

}  // namespace stepwright::bench

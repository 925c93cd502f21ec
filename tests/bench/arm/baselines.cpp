#include "tests/bench/arm/baselines.h"

#include <stdexcept>

#include "supervisor/motion/ompl/ompl_planner.h"
#include "tests/bench/arm/measure.h"

namespace stepwright::bench {

using namespace motion;

namespace {

void ask(const ProblemSet& set, const ArmProblem& problem, const FreeSpace& free, OmplOptions options,
         BaselineFigures& figures) {
  double solve_ms = 0.0;
  options.solve_ms = &solve_ms;
  const auto answer = plan_by_ompl("RRTConnect", free, joint_space(set.model.robot, problem.coordinates),
                                   problem.from, {problem.to}, options);
  if (!answer) throw std::runtime_error(to_string(answer.error()));
  ++figures.asked;
  if (answer->path.empty()) return;
  ++figures.solved;
  figures.solve_ms.push_back(solve_ms);
}

bool better(const BaselineFigures& a, const BaselineFigures& b) {
  if (a.solved != b.solved) return a.solved > b.solved;
  return quantile(a.solve_ms, 0.5) < quantile(b.solve_ms, 0.5);
}

}  // namespace

BaselineFigures ompl_on_spheres(const ProblemSet& set, const std::vector<std::size_t>& numbers,
                                bool whole_motions, double seconds) {
  BaselineFigures best;
  bool first = true;
  for (const double range : {0.0, 0.5, 1.0, 2.0, 4.0}) {
    BaselineFigures figures;
    figures.range = range;
    for (const std::size_t number : numbers) {
      const ArmCheckers fast = fast_checkers(set, set.problems[number]);
      ask(set, set.problems[number], fast.fast(),
          {.seconds = seconds, .range = range, .whole_motions = whole_motions}, figures);
    }
    if (first || better(figures, best)) best = std::move(figures);
    first = false;
  }
  return best;
}

BaselineFigures ompl_on_bodies(const ProblemSet& set, const std::vector<std::size_t>& numbers,
                               double seconds) {
  BaselineFigures figures;
  ExactCheckers checkers(set);
  for (const std::size_t number : numbers) {
    const ExactChecker exact = checkers.of(set.problems[number], false);
    ask(set, set.problems[number], by_bodies(exact), {.seconds = seconds, .whole_motions = false}, figures);
  }
  return figures;
}

}  // namespace stepwright::bench

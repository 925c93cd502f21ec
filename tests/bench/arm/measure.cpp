#include "tests/bench/arm/measure.h"

#include <algorithm>
#include <ctime>
#include <functional>
#include <optional>
#include <stdexcept>

#include "tests/bench/arm/baselines.h"

namespace stepwright::bench {

using namespace motion;

double processor_ms(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

ArmCheckers fast_checkers(const ProblemSet& set, const ArmProblem& problem) {
  auto made = ArmCheckers::make(set.model, problem, set.pairs);
  if (!made) throw std::runtime_error(to_string(made.error()));
  return std::move(*made);
}

ExactCheckers::ExactCheckers(const ProblemSet& set) : set_(set) {}

ExactChecker ExactCheckers::of(const ArmProblem& problem, bool with_spheres) {
  auto& known = with_spheres ? quick_ : plain_;
  auto made = known ? known->with(problem.world, problem.rest, problem.attached)
                    : ExactChecker::make(set_.model.robot, set_.model.bodies, set_.model.known_pairs(),
                                         problem.world, problem.coordinates, problem.rest,
                                         with_spheres ? &set_.model.spheres : nullptr, problem.attached);
  if (!made) throw std::runtime_error(to_string(made.error()));
  if (known) return std::move(*made);
  known = std::move(*made);
  return *known->with(problem.world, problem.rest, problem.attached);
}

namespace {

// Places along a path at which the bodies meet, by a checker that knows of no spheres.
bool meets_somewhere(const ExactChecker& plain, const JointPath& path) {
  constexpr double kStep = 0.02;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const double far = joint_distance(path[k - 1], path[k]);
    const auto steps = static_cast<std::size_t>(far / kStep) + 1;
    for (std::size_t s = 0; s <= steps; ++s) {
      Configuration q = path[k - 1];
      for (std::size_t j = 0; j < q.size(); ++j)
        q[j] += static_cast<double>(s) / static_cast<double>(steps) * (path[k][j] - q[j]);
      if (plain.contact(q)) return true;
    }
  }
  return false;
}

void measure_one(const ProblemSet& set, std::size_t number, ExactCheckers& checkers, OwnFigures& figures) {
  const ArmProblem& problem = set.problems[number];
  ++figures.problems;
  const ExactChecker exact = checkers.of(problem, true);
  const JointSpace space = joint_space(set.model.robot, problem.coordinates);
  if (!inside(space, problem.from) || !inside(space, problem.to) || exact.contact(problem.from) ||
      exact.contact(problem.to))
    return;
  ++figures.valid;
  const ArmCheckers made = fast_checkers(set, problem);
  const FreeSpace warm = made.fast();
  if (warm.is_free(problem.from) && warm.is_free(problem.to)) {
    PathAnswer raw;
    const double first_ms = processor_ms([&] { raw = plan_path(warm, space, problem.from, {problem.to}); });
    if (!raw.path.empty()) {
      figures.measured.push_back(number);
      figures.first_ms.push_back(first_ms);
      figures.shortened_ms.push_back(first_ms + processor_ms([&] { (void)shorten(warm, raw.path); }));
    }
  }
  CertainPath answer;
  const double certain_ms = processor_ms([&] {
    const ArmCheckers fast = fast_checkers(set, problem);
    const FreeSpace quick = fast.fast(), careful = fast.careful();
    answer = plan_certain_path(quick, exact, space, problem.from, {problem.to}, {}, {.careful = &careful});
  });
  if (answer.path.empty()) {
    figures.unsolved.push_back(set.names[number]);
    return;
  }
  ++figures.solved;
  figures.certain_ms.push_back(certain_ms);
  figures.by_ways += answer.means == CertainPath::Means::WaysOut;
  figures.by_bodies += answer.means == CertainPath::Means::ByBodies;
  const ExactChecker plain = checkers.of(problem, false);
  if (first_refused(exact, answer.path) || meets_somewhere(plain, answer.path)) ++figures.collisions;
}

}  // namespace

OwnFigures measure_ours(const ProblemSet& set) {
  OwnFigures figures;
  ExactCheckers checkers(set);
  for (std::size_t k = 0; k < set.problems.size(); ++k) measure_one(set, k, checkers, figures);
  return figures;
}

}  // namespace stepwright::bench

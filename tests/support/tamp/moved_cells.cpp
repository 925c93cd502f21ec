#include "tests/support/tamp/moved_cells.h"

#include <array>
#include <numbers>

#include "supervisor/tamp/intervals/cause/nearest_value.h"
#include "supervisor/tamp/intervals/cause/witness.h"

namespace stepwright::tamp::testing {
namespace {

constexpr std::array kParameters{Parameter::RegionX,    Parameter::RegionY,   Parameter::RegionHeight,
                                 Parameter::StartX,     Parameter::StartY,    Parameter::StartHeight,
                                 Parameter::StartAngle, Parameter::FinalAngle};

bool is_feasible(const Problem& problem) {
  return solve(problem.cell, problem.sequence).answer == Answer::Feasible;
}

// A handle leaves the hand little choice, so that angles matter.
Problem any_problem(const TwoArms& arms, std::uint64_t seed, Random& random) {
  Problem problem = random.below(2) == 0 ? experiment_1(arms, seed) : experiment_2(arms, seed);
  const std::size_t shape = random.below(3);
  if (shape == 0) return problem;
  problem.cell.grasps[0].angles = {{-0.3, 0.3}};
  if (shape == 1) problem.sequence = {pick(kRight, 0), place(kRight, 0, 0, random.from_to(-3.0, 3.0))};
  return problem;
}

std::size_t subject_of(Parameter parameter, const Problem& problem, Random& random) {
  if (parameter == Parameter::FinalAngle) return problem.sequence.size() - 1;
  const bool is_region = parameter == Parameter::RegionX || parameter == Parameter::RegionY ||
                         parameter == Parameter::RegionHeight;
  if (!is_region) return 0;
  // Of a region that is used.
  for (;;) {
    const std::size_t region = random.below(problem.cell.regions.size());
    for (const Action& action : problem.sequence)
      if (action.region == region) return region;
  }
}

}  // namespace

MovedCell moved_cell(const TwoArms& arms, std::uint64_t seed) {
  Random random(seed * 1'000'003);
  for (std::uint64_t round = 0;; ++round) {
    MovedCell moved{any_problem(arms, seed * 1'000 + round, random)};
    if (!is_feasible(moved.problem)) continue;
    for (int tries = 0; tries < 6; ++tries) {
      MovedCell next = moved;
      next.parameter = kParameters[random.below(kParameters.size())];
      next.subject = subject_of(next.parameter, next.problem, random);
      next.before = value_of(next.problem.cell, next.problem.sequence, next.parameter, next.subject, 0);
      const double least = next.is_angle() ? 0.5 : 0.05, most = next.is_angle() ? std::numbers::pi : 0.7;
      const double by = random.from_to(least, most) * (random.below(2) == 0 ? 1.0 : -1.0);
      set_value(next.problem.cell, next.problem.sequence, next.parameter, next.subject, 0, next.before + by);
      if (solve(next.problem.cell, next.problem.sequence).answer == Answer::Infeasible) return next;
    }
  }
}

bool fixes(const Constraint& each, const MovedCell& moved) {
  switch (moved.parameter) {
    case Parameter::RegionX:
    case Parameter::RegionY:
      return each.kind == ConstraintKind::RegionArea && each.region == moved.subject;
    case Parameter::RegionHeight:
      return each.kind == ConstraintKind::RegionHeight && each.region == moved.subject;
    case Parameter::StartX:
    case Parameter::StartY:
      return each.kind == ConstraintKind::StartPosition;
    case Parameter::StartHeight:
      return each.kind == ConstraintKind::StartHeight;
    case Parameter::StartAngle:
      return each.kind == ConstraintKind::StartAngle;
    case Parameter::FinalAngle:
      return each.kind == ConstraintKind::FinalAngle && each.action == moved.subject;
    case Parameter::Distance:
      return false;
  }
  return false;
}

}  // namespace stepwright::tamp::testing

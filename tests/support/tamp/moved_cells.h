#pragma once

// Cells that were feasible until one number of them was moved: what a cause must find. The same seed is the
// same cell.

#include "supervisor/tamp/intervals/cause/cause.h"
#include "tests/support/tamp/experiments.h"

namespace stepwright::tamp::testing {

struct MovedCell {
  Problem problem;  // infeasible
  Parameter parameter = Parameter::RegionHeight;
  std::size_t subject = 0;
  double before = 0.0;  // with which it was feasible

  bool is_angle() const { return parameter == Parameter::StartAngle || parameter == Parameter::FinalAngle; }
};

MovedCell moved_cell(const TwoArms& arms, std::uint64_t seed);

// Whether the constraint is what holds the moved number.
bool fixes(const Constraint& each, const MovedCell& moved);

}  // namespace stepwright::tamp::testing

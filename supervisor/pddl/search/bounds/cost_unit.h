#pragma once

// Unit of costs: where all costs are multiples of one number, so is what a plan costs, and bounds are rounded
// up to it.
//
// Thread rule: pure functions.

#include <span>

namespace stepwright::pddl {

// The greatest number of which all costs are multiples; 0 if there is none that is worth it.
double common_unit(std::span<const double> costs);

// The least multiple that is not below the bound, errors of rounding allowed for.
double rounded_up(double bound, double unit);

}  // namespace stepwright::pddl

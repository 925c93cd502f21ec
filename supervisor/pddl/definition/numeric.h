#pragma once

// The arithmetic of fluents: one meaning of "equal" and "less" for planner and validator.
//
// PDDL's numbers are decimals, ours are doubles, so that 0.1 + 0.2 must still equal 0.3. Values are rounded
// to a grid of 1e-9 when they are stored, and comparisons allow half a grid step; both leave integers
// untouched. A number of a file that the grid would lose is refused (P0009, `Rounding`).

#include <cmath>
#include <cstdint>

#include "supervisor/pddl/definition/numeric_kinds.h"

namespace stepwright::pddl {

// The nearest multiple of 1e-9; values above 1e6 in magnitude, where doubles are coarser, stay as they are.
inline double snap(double value) {
  if (!(std::abs(value) < 1e6) || value == std::nearbyint(value)) return value + 0.0;
  return std::nearbyint(value * 1e9) / 1e9 + 0.0;
}

// Effect of the grid on a number.
enum class Rounding : std::uint8_t {
  None,    // but for what doubles cannot tell
  Digits,  // its last digits: two numbers that differ only there are equal
  Lost,    // nothing or too little is left: less than three digits
};

inline Rounding rounding_of(double value) {
  const double change = std::abs(snap(value) - value);
  if (change > 1e-3 * std::abs(value)) return Rounding::Lost;
  return change > 1e-12 + 1e-15 * std::abs(value) ? Rounding::Digits : Rounding::None;
}

// Negation of a relation. 'Not equal' is no relation: Equal is returned as it is, and callers split it in
// two.
inline Relation opposite(Relation relation) {
  switch (relation) {
    case Relation::Less:
      return Relation::GreaterEqual;
    case Relation::LessEqual:
      return Relation::Greater;
    case Relation::GreaterEqual:
      return Relation::Less;
    case Relation::Greater:
      return Relation::LessEqual;
    case Relation::Equal:
      break;
  }
  return Relation::Equal;
}

// `difference` is left - right.
inline bool compare(Relation relation, double difference) {
  constexpr double kTolerance = 5e-10;
  switch (relation) {
    case Relation::Less:
      return difference < -kTolerance;
    case Relation::LessEqual:
      return difference <= kTolerance;
    case Relation::Equal:
      return std::abs(difference) <= kTolerance;
    case Relation::GreaterEqual:
      return difference >= -kTolerance;
    case Relation::Greater:
      return difference > kTolerance;
  }
  return false;
}

}  // namespace stepwright::pddl

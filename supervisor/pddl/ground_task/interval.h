#pragma once

// Closed intervals of doubles: what a fluent can be in a relaxed state. Empty = undefined so far.
//
// Thread rule: plain values.

#include <algorithm>
#include <limits>

#include "supervisor/pddl/definition/numeric.h"

namespace stepwright::pddl {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Interval {
  double low = kInfinity;
  double high = -kInfinity;

  static Interval point(double value) { return {value, value}; }
  static Interval everything() { return {-kInfinity, kInfinity}; }
  bool empty() const { return low > high; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

inline Interval hull(Interval a, Interval b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

inline Interval operator+(Interval a, Interval b) {
  if (a.empty() || b.empty()) return {};
  return {a.low + b.low, a.high + b.high};
}

inline Interval operator-(Interval a) {
  return {-a.high, -a.low};
}

inline Interval operator-(Interval a, Interval b) {
  return a + -b;
}

// 0 x kInfinity is 0 here: the infinite end is never reached.
inline double bounded_product(double a, double b) {
  return a == 0.0 || b == 0.0 ? 0.0 : a * b;
}

inline Interval operator*(Interval a, Interval b) {
  if (a.empty() || b.empty()) return {};
  const double p = bounded_product(a.low, b.low), q = bounded_product(a.low, b.high);
  const double r = bounded_product(a.high, b.low), s = bounded_product(a.high, b.high);
  return {std::min({p, q, r, s}), std::max({p, q, r, s})};
}

inline Interval operator/(Interval a, Interval b) {
  if (a.empty() || b.empty() || (b.low == 0.0 && b.high == 0.0)) return {};
  if (b.low <= 0.0 && b.high >= 0.0) return Interval::everything();
  return a * Interval{1.0 / b.high, 1.0 / b.low};
}

// Can a value of the interval stand in that relation to zero?
inline bool possible(Relation relation, Interval difference) {
  if (difference.empty()) return false;
  switch (relation) {
    case Relation::Less:
    case Relation::LessEqual:
      return compare(relation, difference.low);
    case Relation::Greater:
    case Relation::GreaterEqual:
      return compare(relation, difference.high);
    case Relation::Equal:
      return compare(Relation::LessEqual, difference.low) && compare(Relation::GreaterEqual, difference.high);
  }
  return false;
}

}  // namespace stepwright::pddl

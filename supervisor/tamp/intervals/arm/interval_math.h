#pragma once

// Intervals of real numbers and vectors of them: whatever the numbers are, the result is within. Each result
// is widened by 1e-14, which is more than the rounding of one operation on numbers below ten; that is what
// all of this is for: directions, and places of arms in units of their own. Values; any thread.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace stepwright::tamp {

struct Real {
  static constexpr double kRounding = 1e-14;

  double low = 0.0, high = 0.0;

  Real() = default;
  Real(double value) : low(value), high(value) {}
  Real(double from, double to) : low(from), high(to) {}

  double width() const { return high - low; }
  double middle() const { return 0.5 * (low + high); }
  bool contains(double value) const { return low <= value && value <= high; }

  static Real widened(double from, double to) { return {from - kRounding, to + kRounding}; }
  friend Real operator+(Real a, Real b) { return Real::widened(a.low + b.low, a.high + b.high); }
  friend Real operator-(Real a, Real b) { return Real::widened(a.low - b.high, a.high - b.low); }
  friend Real operator-(Real a) { return {-a.high, -a.low}; }
  friend Real operator*(double k, Real a) {
    return k >= 0.0 ? Real::widened(k * a.low, k * a.high) : Real::widened(k * a.high, k * a.low);
  }
  friend Real operator*(Real a, Real b) {
    const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
    return Real::widened(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
  }
};

// Requires one that does not hold 0.
inline Real inverse_of(Real a) {
  return Real::widened(1.0 / a.high, 1.0 / a.low);
}
inline Real square_of(Real a) {
  const double low = a.low * a.low, high = a.high * a.high;
  return Real::widened(a.contains(0.0) ? 0.0 : std::min(low, high), std::max(low, high));
}
inline Real root_of(Real a) {
  return Real::widened(std::sqrt(std::max(a.low, 0.0)), std::sqrt(std::max(a.high, 0.0)));
}
inline Real arc_cosine_of(Real a) {
  constexpr double kSlack = 1e-13;
  return {std::acos(std::min(1.0, a.high)) - kSlack, std::acos(std::max(-1.0, a.low)) + kSlack};
}
// The cosine of all angles from low to high. Any angles.
inline Real cosine_of(Real angle) {
  constexpr double kPi = std::numbers::pi;
  const double a = std::cos(angle.low), b = std::cos(angle.high);
  // A multiple of pi within: the cosine is 1 or -1 there.
  const double first = std::ceil(angle.low / kPi), last = std::floor(angle.high / kPi);
  Real result{std::min(a, b), std::max(a, b)};
  if (last - first >= 1.0) return {-1.0, 1.0};
  if (last == first) {
    if (std::fmod(first, 2.0) == 0.0)
      result.high = 1.0;
    else
      result.low = -1.0;
  }
  return Real::widened(result.low, result.high);
}
inline Real sine_of(Real angle) {
  return cosine_of(angle - Real(0.5 * std::numbers::pi));
}
// Of points to the right of the y axis.
inline Real angle_to_the_right(Real y, Real x) {
  constexpr double kSlack = 1e-13;
  return {std::atan2(y.low, y.low < 0.0 ? x.low : x.high) - kSlack,
          std::atan2(y.high, y.high > 0.0 ? x.low : x.high) + kSlack};
}
// All angles of (x, y), as one interval that may go beyond pi; a whole turn where (0, 0) is among them.
inline Real angle_of(Real y, Real x) {
  constexpr double kPi = std::numbers::pi, kSlack = 1e-13;
  y = {y.low - kSlack, y.high + kSlack};
  x = {x.low - kSlack, x.high + kSlack};
  if (x.low > 0.0) return angle_to_the_right(y, x);
  if (x.high < 0.0) return angle_to_the_right(-y, -x) + Real(kPi);
  if (y.low > 0.0) return angle_to_the_right(-x, y) + Real(0.5 * kPi);
  if (y.high < 0.0) return angle_to_the_right(x, -y) - Real(0.5 * kPi);
  return {-kPi, kPi};
}

struct RealVector {
  std::array<Real, 3> v;

  const Real& operator[](std::size_t k) const { return v[k]; }
  friend RealVector operator+(const RealVector& a, const RealVector& b) {
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
  }
  friend RealVector operator-(const RealVector& a, const RealVector& b) {
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
  }
  friend RealVector operator*(Real k, const RealVector& a) { return {{k * a[0], k * a[1], k * a[2]}}; }
};

inline Real dot_of(const RealVector& a, const RealVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline RealVector cross_of(const RealVector& a, const RealVector& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
inline Real length_of(const RealVector& a) {
  return root_of(square_of(a[0]) + square_of(a[1]) + square_of(a[2]));
}
// Of directions no part is beyond 1.
inline RealVector within_unit(RealVector a) {
  for (Real& part : a.v) part = {std::max(part.low, -1.0), std::min(part.high, 1.0)};
  return a;
}

}  // namespace stepwright::tamp

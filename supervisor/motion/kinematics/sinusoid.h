#pragma once

// Functions a + b cos(t) + c sin(t): what a coordinate of a point is that goes round an axis. Values; any
// thread.

#include <array>
#include <cstddef>
#include <span>

#include "supervisor/motion/spatial/vector.h"

namespace stepwright::motion {

struct Sinusoid {
  double constant = 0.0, with_cosine = 0.0, with_sine = 0.0;

  double at(double cosine, double sine) const { return constant + with_cosine * cosine + with_sine * sine; }
  friend Sinusoid operator+(Sinusoid a, Sinusoid b) {
    return {a.constant + b.constant, a.with_cosine + b.with_cosine, a.with_sine + b.with_sine};
  }
  friend Sinusoid operator*(double k, Sinusoid a) {
    return {k * a.constant, k * a.with_cosine, k * a.with_sine};
  }
};

// A vector that goes round an axis of length 1, by the angle t: about(axis, t) * start.
struct GoingRound {
  Vector3 constant, with_cosine, with_sine;

  GoingRound(Vector3 axis, Vector3 start)
      : constant(dot(axis, start) * axis), with_cosine(start - constant), with_sine(cross(axis, start)) {}
  Sinusoid along(Vector3 direction) const {
    return {dot(constant, direction), dot(with_cosine, direction), dot(with_sine, direction)};
  }
};

// The angles in [-pi, pi) at which it is zero: at most two, in no order. Where it only touches zero, or
// misses it by rounding, the place that is nearest to zero counts.
struct Roots {
  std::array<double, 2> angles{};
  std::size_t count = 0;
};
Roots roots(const Sinusoid& of);

// To [-pi, pi).
double wrapped(double angle_rad);

}  // namespace stepwright::motion

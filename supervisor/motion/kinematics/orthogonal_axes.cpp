#include "supervisor/motion/kinematics/orthogonal_axes.h"

#include <cmath>

namespace stepwright::motion {

// With a3 = about(a2, skew) a1 and the inner angle f = q2 + skew, the third axis is carried to
//   cos f a1 - sin f cos q1 (a1 x a2) + sin f sin q1 a2,
// and the inverse carries the first axis to
//   cos f a3 + sin f cos q3 (a3 x a2) + sin f sin q3 a2.
OrthogonalAxes::OrthogonalAxes(Vector3 first, Vector3 second, Vector3 third)
    : first_(first),
      second_(second),
      third_(third),
      beside_first_(cross(first, second)),
      beside_third_(cross(third, second)),
      skew_(std::atan2(dot(second, cross(first, third)), dot(first, third))) {}

Rotation OrthogonalAxes::rotation(const std::array<double, 3>& values) const {
  return about(first_, values[0]) * about(second_, values[1]) * about(third_, values[2]);
}

bool OrthogonalAxes::flipped(double second_value) const {
  return std::sin(second_value + skew_) < 0.0;
}

std::array<double, 3> OrthogonalAxes::values(const Rotation& made, bool flipped) const {
  const double side = flipped ? -1.0 : 1.0;
  const Vector3 third = made * third_;
  const double y = dot(third, second_), x = -dot(third, beside_first_);
  const double sine = std::hypot(x, y);
  const double inner = side * std::atan2(sine, dot(third, first_));
  constexpr double kTogether = 1e-13;
  const double q1 = sine < kTogether ? 0.0 : wrapped(std::atan2(side * y, side * x));
  const double q2 = wrapped(inner - skew_);
  // The third value is what is left: so an error of the first, large where the axes nearly fall together,
  // cancels.
  const Vector3 turned = about(second_, -q2) * (about(first_, -q1) * (made * second_));
  return {q1, q2, wrapped(std::atan2(dot(third_, cross(second_, turned)), dot(second_, turned)))};
}

OrthogonalAxes::Course OrthogonalAxes::course(const GoingRound& third_carried,
                                              const GoingRound& first_carried_back) const {
  return {third_carried.along(first_), third_carried.along(second_),
          -1.0 * third_carried.along(beside_first_), first_carried_back.along(second_),
          first_carried_back.along(beside_third_)};
}

}  // namespace stepwright::motion

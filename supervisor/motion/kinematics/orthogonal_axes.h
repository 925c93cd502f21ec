#pragma once

// Three turning joints whose axes meet in a point, the second at right angles to both others: a shoulder, a
// wrist.
//
// With the axes as they stand at the values 0, in one frame, the joint makes about(a1, q1) about(a2, q2)
// about(a3, q3). Each rotation is made by two triples of values, told apart by `flipped`. A value; any
// thread.
//
//   const OrthogonalAxes wrist(a5, a6, a7);
//   const auto values = wrist.values(rotation, false);

#include <array>

#include "supervisor/motion/kinematics/sinusoid.h"
#include "supervisor/motion/spatial/transform.h"

namespace stepwright::motion {

class OrthogonalAxes {
 public:
  OrthogonalAxes(Vector3 first, Vector3 second, Vector3 third);
  OrthogonalAxes() : OrthogonalAxes({0, 0, 1}, {0, 1, 0}, {0, 0, 1}) {}

  Rotation rotation(const std::array<double, 3>& values) const;
  // In [-pi, pi). Where the first and third axis fall together only their sum matters: then the first value
  // is 0.
  std::array<double, 3> values(const Rotation& made, bool flipped) const;
  // The side that values are on.
  bool flipped(double second_value) const;

  const Vector3& first() const { return first_; }
  const Vector3& second() const { return second_; }
  const Vector3& third() const { return third_; }

  // For a rotation that changes: where it carries the third axis, and where its inverse carries the first
  // one, as sums that the values follow from. Of values in the order of `values`:
  //   cos(q2 + skew) = inner; q1 = atan2(side * first_sine, side * first_cosine); q3 likewise. side: -1 if
  //   flipped.
  struct Course {
    Sinusoid inner;
    Sinusoid first_sine, first_cosine;
    Sinusoid third_sine, third_cosine;
  };
  Course course(const GoingRound& third_carried, const GoingRound& first_carried_back) const;
  double skew() const { return skew_; }

 private:
  Vector3 first_, second_, third_;
  Vector3 beside_first_, beside_third_;
  double skew_ = 0.0;  // the third axis is the first one turned about the second by this
};

}  // namespace stepwright::motion

#pragma once

// A joint that turns, prepared for many values: origin * about(axis, angle) as a sum of three matrices, so
// that an angle costs its sine, its cosine and 18 products. A value; any thread.

#include <cmath>

#include "supervisor/motion/spatial/transform.h"

namespace stepwright::motion {

class Turning {
 public:
  Turning() = default;
  Turning(const Rotation& origin, Vector3 axis) {
    const Rotation straight = about(axis, 0.0), quarter = about(axis, std::acos(0.0)),
                   half = about(axis, 2.0 * std::acos(0.0));
    Rotation still, with_sine, with_cosine;
    for (std::size_t k = 0; k < 9; ++k) {
      still.m[k] = 0.5 * (straight.m[k] + half.m[k]);
      with_cosine.m[k] = 0.5 * (straight.m[k] - half.m[k]);
      with_sine.m[k] = quarter.m[k] - still.m[k];
    }
    still_ = origin * still;
    with_sine_ = origin * with_sine;
    with_cosine_ = origin * with_cosine;
  }

  Rotation at(double angle_rad) const {
    const double s = std::sin(angle_rad), c = std::cos(angle_rad);
    Rotation turned;
    for (std::size_t k = 0; k < 9; ++k)
      turned.m[k] = still_.m[k] + c * with_cosine_.m[k] + s * with_sine_.m[k];
    return turned;
  }

  const Rotation& still() const { return still_; }
  const Rotation& with_sine() const { return with_sine_; }
  const Rotation& with_cosine() const { return with_cosine_; }

 private:
  Rotation still_, with_sine_, with_cosine_;
};

}  // namespace stepwright::motion

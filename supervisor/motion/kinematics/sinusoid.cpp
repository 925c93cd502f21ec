#include "supervisor/motion/kinematics/sinusoid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stepwright::motion {

double wrapped(double angle_rad) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (angle_rad >= -std::numbers::pi && angle_rad < std::numbers::pi) return angle_rad;
  const double inside = angle_rad - kTurn * std::floor((angle_rad + std::numbers::pi) / kTurn);
  return inside >= std::numbers::pi ? -std::numbers::pi : inside;
}

Roots roots(const Sinusoid& of) {
  constexpr double kRounding = 1e-12;
  const double amplitude = std::hypot(of.with_cosine, of.with_sine);
  if (amplitude < 1e-14) return {};  // it stands still: zero nowhere or everywhere, and so no border
  const double level = -of.constant / amplitude;
  if (std::abs(level) > 1.0 + kRounding) return {};
  const double middle = std::atan2(of.with_sine, of.with_cosine);
  const double aside = std::acos(std::clamp(level, -1.0, 1.0));
  return {{wrapped(middle - aside), wrapped(middle + aside)}, 2};
}

}  // namespace stepwright::motion

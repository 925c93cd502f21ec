#include "plant_models/body2d/body_geometry.h"

#include <algorithm>
#include <array>

namespace stepwright::body2d {
namespace {

// Cuts [from, to] of the segment's parameter down to where start + t * step lies within +-half.
bool clip(double start, double step, double half, double& from, double& to) {
  if (step == 0.0) return std::abs(start) <= half;
  const double a = (-half - start) / step;
  const double b = (half - start) / step;
  from = std::max(from, std::min(a, b));
  to = std::min(to, std::max(a, b));
  return from <= to;
}

}  // namespace

Vec2 to_plane(const Pose& pose, Vec2 own) {
  const double c = std::cos(pose.angle);
  const double s = std::sin(pose.angle);
  return pose.position + Vec2{c * own.x - s * own.y, s * own.x + c * own.y};
}

Vec2 to_own(const Pose& pose, Vec2 point) {
  const double c = std::cos(pose.angle);
  const double s = std::sin(pose.angle);
  const Vec2 d = point - pose.position;
  return {c * d.x + s * d.y, c * d.y - s * d.x};
}

bool crosses(const Rectangle& rectangle, const Pose& pose, Vec2 a, Vec2 b) {
  const Vec2 start = to_own(pose, a);
  const Vec2 step = to_own(pose, b) - start;
  double from = 0.0;
  double to = 1.0;
  return clip(start.x, step.x, rectangle.size.x / 2.0, from, to) &&
         clip(start.y, step.y, rectangle.size.y / 2.0, from, to);
}

}  // namespace stepwright::body2d

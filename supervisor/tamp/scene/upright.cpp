#include "supervisor/tamp/scene/upright.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stepwright::tamp::scene {

namespace {

// How far the point lies outside of the rectangle; below zero inside.
double gap_to_point(const Upright& box, double x_m, double y_m) {
  const double c = std::cos(box.heading_rad), s = std::sin(box.heading_rad);
  const double dx = x_m - box.x_m, dy = y_m - box.y_m;
  const double along = std::abs(c * dx + s * dy) - box.half_x_m,
               across = std::abs(c * dy - s * dx) - box.half_y_m;
  if (along <= 0.0 || across <= 0.0) return std::max(along, across);
  return std::hypot(along, across);
}

// Along the sides of `a`: how far the boxes are apart there at the most.
double gap_along_sides(const Upright& a, const Upright& b) {
  const double turn = b.heading_rad - a.heading_rad;
  const double c = std::abs(std::cos(turn)), s = std::abs(std::sin(turn));
  const double ca = std::cos(a.heading_rad), sa = std::sin(a.heading_rad);
  const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m;
  const double along = std::abs(ca * dx + sa * dy) - a.half_x_m - (c * b.half_x_m + s * b.half_y_m);
  const double across = std::abs(ca * dy - sa * dx) - a.half_y_m - (s * b.half_x_m + c * b.half_y_m);
  return std::max(along, across);
}

}  // namespace

Upright standing(const Form& form, const Pose& pose) {
  Upright body;
  body.round = form.round;
  body.x_m = pose.x_m;
  body.y_m = pose.y_m;
  body.heading_rad = pose.angle_rad;
  body.radius_m = form.radius_m;
  body.half_x_m = 0.5 * form.size_x_m;
  body.half_y_m = 0.5 * form.size_y_m;
  body.low_m = pose.z_m;
  body.high_m = pose.z_m + form.height_m;
  return body;
}

double gap(const Upright& a, const Upright& b) {
  if (a.round && b.round) return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) - a.radius_m - b.radius_m;
  if (a.round) return gap_to_point(b, a.x_m, a.y_m) - a.radius_m;
  if (b.round) return gap_to_point(a, b.x_m, b.y_m) - b.radius_m;
  return std::max(gap_along_sides(a, b), gap_along_sides(b, a));
}

bool share_heights(const Upright& a, const Upright& b) {
  return std::min(a.high_m, b.high_m) - std::max(a.low_m, b.low_m) > kTouch_m;
}

bool meet(const Upright& a, const Upright& b, double clearance_m) {
  return share_heights(a, b) && gap(a, b) < clearance_m;
}

double radius_around(const Form& form) {
  return form.round ? form.radius_m : 0.5 * std::hypot(form.size_x_m, form.size_y_m);
}

}  // namespace stepwright::tamp::scene

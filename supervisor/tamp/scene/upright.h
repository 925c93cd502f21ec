#pragma once

// Bodies that stand upright: a circle or a turned rectangle seen from above, and a range of heights. Exact
// where spheres around bodies are too large: cans side by side on a tray, fingers between them.
//
// Values and pure functions; any thread.
//
//   const Upright can = standing({.round = true, .radius_m = 0.035, .height_m = 0.12}, pose);
//   if (meet(can, finger, 0.001)) ...

namespace stepwright::tamp::scene {

// The shape of something that stands: a cylinder or a box.
struct Form {
  bool round = true;
  double radius_m = 0.0;                  // of a cylinder
  double size_x_m = 0.0, size_y_m = 0.0;  // full sides of a box
  double height_m = 0.0;
};

// Of the middle of its underside; the angle about the vertical.
struct Pose {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0, angle_rad = 0.0;
  friend bool operator==(const Pose&, const Pose&) = default;
};

struct Upright {
  bool round = true;
  double x_m = 0.0, y_m = 0.0, heading_rad = 0.0;
  double radius_m = 0.0;                  // of a round one
  double half_x_m = 0.0, half_y_m = 0.0;  // of the others
  double low_m = 0.0, high_m = 0.0;       // heights
};

Upright standing(const Form& form, const Pose& pose);

// How far they are apart seen from above: not more than the true distance, below zero where they overlap.
double gap(const Upright& a, const Upright& b);
// By more than `kTouch_m`.
bool share_heights(const Upright& a, const Upright& b);
// They share heights and are less than `clearance_m` apart.
bool meet(const Upright& a, const Upright& b, double clearance_m);
// What touches with its underside or top does not meet.
inline constexpr double kTouch_m = 2e-4;

// From its middle to the farthest point, seen from above.
double radius_around(const Form& form);

}  // namespace stepwright::tamp::scene

#pragma once

// Points and poses of the plane: metres, radians anticlockwise from the x axis. Values.

#include <cmath>

namespace stepwright::geometry {

struct Point {
  double x_m = 0.0;
  double y_m = 0.0;

  friend bool operator==(const Point&, const Point&) = default;
  friend Point operator+(Point a, Point b) { return {a.x_m + b.x_m, a.y_m + b.y_m}; }
  friend Point operator-(Point a, Point b) { return {a.x_m - b.x_m, a.y_m - b.y_m}; }
  friend Point operator*(double factor, Point a) { return {factor * a.x_m, factor * a.y_m}; }
};

inline double dot(Point a, Point b) {
  return a.x_m * b.x_m + a.y_m * b.y_m;
}
// Positive where b points to the left of a.
inline double cross(Point a, Point b) {
  return a.x_m * b.y_m - a.y_m * b.x_m;
}
inline double distance(Point a, Point b) {
  return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
}

struct Pose {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;

  Point position() const { return {x_m, y_m}; }
  friend bool operator==(const Pose&, const Pose&) = default;
};

// A point of the frame of `pose` in the frame in which the pose is given.
inline Point from_frame(const Pose& pose, Point local) {
  const double c = std::cos(pose.heading_rad);
  const double s = std::sin(pose.heading_rad);
  return {pose.x_m + c * local.x_m - s * local.y_m, pose.y_m + s * local.x_m + c * local.y_m};
}

}  // namespace stepwright::geometry

#pragma once

// Points, poses and rectangles in a plane, SI units, angles counter-clockwise in radians. Values; use from
// any thread.

#include <cmath>

namespace stepwright::body2d {

struct Vec2 {
  double x = 0.0;
  double y = 0.0;

  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(double s, Vec2 v) { return {s * v.x, s * v.y}; }
  friend constexpr bool operator==(Vec2, Vec2) = default;
};

inline double length(Vec2 v) {
  return std::sqrt(v.x * v.x + v.y * v.y);
}

constexpr double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}

struct Pose {
  Vec2 position;
  double angle = 0.0;

  friend constexpr bool operator==(const Pose&, const Pose&) = default;
};

struct Motion {
  Vec2 velocity;      // of the centre, m/s
  double spin = 0.0;  // rad/s

  friend constexpr bool operator==(const Motion&, const Motion&) = default;
};

// Axis-parallel; a point on the border is inside.
struct Area {
  Vec2 low;
  Vec2 high;

  constexpr bool contains(Vec2 p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
  }
};

// A rectangle of `size` around the origin, moved by a pose.
struct Rectangle {
  Vec2 size;  // along its own axes
};

// A point of the rectangle's own axes in the plane, and back.
Vec2 to_plane(const Pose& pose, Vec2 own);
Vec2 to_own(const Pose& pose, Vec2 point);

// True if the segment from `a` to `b` meets the rectangle; a segment of no length is a point.
bool crosses(const Rectangle& rectangle, const Pose& pose, Vec2 a, Vec2 b);

}  // namespace stepwright::body2d

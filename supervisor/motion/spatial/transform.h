#pragma once

// Rotations and rigid motions of space. Values; any thread.
//
//   const Transform tool_in_world = base_in_world * tool_in_base;
//   const Vector3 place_m = tool_in_world * Vector3{0, 0, 0.1};
//
// A rotation is an orthonormal matrix; it is kept as given, so products of very many drift by rounding.

#include <array>
#include <cstddef>

#include "supervisor/motion/spatial/vector.h"

namespace stepwright::motion {

struct Rotation {
  std::array<double, 9> m{1, 0, 0, 0, 1, 0, 0, 0, 1};  // row by row

  double operator()(std::size_t row, std::size_t column) const { return m[3 * row + column]; }
  Vector3 column(std::size_t k) const { return {m[k], m[3 + k], m[6 + k]}; }

  friend bool operator==(const Rotation&, const Rotation&) = default;
};

Rotation operator*(const Rotation& a, const Rotation& b);
inline Vector3 operator*(const Rotation& a, Vector3 v) {
  return {a.m[0] * v.x + a.m[1] * v.y + a.m[2] * v.z, a.m[3] * v.x + a.m[4] * v.y + a.m[5] * v.z,
          a.m[6] * v.x + a.m[7] * v.y + a.m[8] * v.z};
}
Rotation transposed(const Rotation& a);
// The rotation whose columns these are; they must be orthonormal and right-handed.
Rotation from_columns(Vector3 x, Vector3 y, Vector3 z);
// By `angle_rad` about an axis of length 1 (Rodrigues).
Rotation about(Vector3 axis, double angle_rad);
// URDF's order: about the fixed axes x, y, z by roll, pitch, yaw.
Rotation from_rpy(double roll_rad, double pitch_rad, double yaw_rad);
// Of any length above zero.
Rotation from_quaternion(double w, double x, double y, double z);
// The vector along the axis whose length is the angle, 0 to pi: the inverse of about().
Vector3 rotation_vector(const Rotation& a);
double angle_between(const Rotation& a, const Rotation& b);

struct Transform {
  Rotation rotation;
  Vector3 position_m;

  friend bool operator==(const Transform&, const Transform&) = default;
};

inline Vector3 operator*(const Transform& a, Vector3 point) {
  return a.rotation * point + a.position_m;
}
Transform operator*(const Transform& a, const Transform& b);
Transform inverse(const Transform& a);

}  // namespace stepwright::motion

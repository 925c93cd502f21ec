#pragma once

// Places, directions and frames of space, m and rad: what the robot cell's bodies are placed with. Values;
// any thread. Frames are right-handed, z up in the cell's own.
//
//   const Frame tool = wrist * Frame{turn_about({0, 0, 1}, 0.5), {0, 0, 0.1}};
//   const Vec3 tip_m = tool.place;

#include <array>
#include <cmath>

namespace stepwright::assemblies {

struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;

  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
};

constexpr double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) {
  return std::sqrt(dot(a, a));
}

// An orthonormal matrix, row by row.
struct Turn {
  std::array<double, 9> m{1, 0, 0, 0, 1, 0, 0, 0, 1};

  constexpr Vec3 column(std::size_t k) const { return {m[k], m[3 + k], m[6 + k]}; }
  friend constexpr bool operator==(const Turn&, const Turn&) = default;
  friend constexpr Vec3 operator*(const Turn& a, Vec3 v) {
    return {a.m[0] * v.x + a.m[1] * v.y + a.m[2] * v.z, a.m[3] * v.x + a.m[4] * v.y + a.m[5] * v.z,
            a.m[6] * v.x + a.m[7] * v.y + a.m[8] * v.z};
  }
  // By the inverse of the turn.
  constexpr Vec3 back(Vec3 v) const {
    return {m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
            m[2] * v.x + m[5] * v.y + m[8] * v.z};
  }
};

Turn operator*(const Turn& a, const Turn& b);
// About an axis of length 1 (Rodrigues).
Turn turn_about(Vec3 axis, double angle_rad);
// About z: how an upright thing stands.
Turn turn_upright(double yaw_rad);

struct Frame {
  Turn turn;
  Vec3 place;

  friend constexpr bool operator==(const Frame&, const Frame&) = default;
  friend constexpr Vec3 operator*(const Frame& a, Vec3 point) { return a.turn * point + a.place; }
};

inline Frame operator*(const Frame& a, const Frame& b) {
  return {a.turn * b.turn, a * b.place};
}

}  // namespace stepwright::assemblies

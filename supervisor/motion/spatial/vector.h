#pragma once

// Vectors of space and what is computed with them. Values; any thread. Lengths are metres where they are
// places.
//
//   const Vector3 normal = normalised(cross(b - a, c - a));

#include <cmath>

namespace stepwright::motion {

struct Vector3 {
  double x = 0.0, y = 0.0, z = 0.0;

  friend constexpr bool operator==(const Vector3&, const Vector3&) = default;
  friend constexpr Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vector3 operator-(Vector3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vector3 operator*(double k, Vector3 a) { return {k * a.x, k * a.y, k * a.z}; }
  constexpr Vector3& operator+=(Vector3 b) { return *this = *this + b; }
};

constexpr double dot(Vector3 a, Vector3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vector3 cross(Vector3 a, Vector3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vector3 a) {
  return std::sqrt(dot(a, a));
}
inline double distance(Vector3 a, Vector3 b) {
  return length(a - b);
}
// Requires a length above zero.
inline Vector3 normalised(Vector3 a) {
  return (1.0 / length(a)) * a;
}
// What is left of `a` without its part along `direction`, which has length 1.
constexpr Vector3 without(Vector3 a, Vector3 direction) {
  return a - dot(a, direction) * direction;
}
// A direction of length 1 at a right angle to `direction`: always the same one for the same input.
inline Vector3 any_normal(Vector3 direction) {
  const Vector3 other = std::abs(direction.x) < 0.6 * length(direction) ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
  return normalised(cross(direction, other));
}
inline bool is_finite(Vector3 a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace stepwright::motion

#include "supervisor/motion/spatial/transform.h"

#include <algorithm>
#include <numbers>

namespace stepwright::motion {

Rotation operator*(const Rotation& a, const Rotation& b) {
  Rotation product;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      product.m[3 * row + column] = a.m[3 * row] * b.m[column] + a.m[3 * row + 1] * b.m[3 + column] +
                                    a.m[3 * row + 2] * b.m[6 + column];
  return product;
}

Rotation transposed(const Rotation& a) {
  return {{a.m[0], a.m[3], a.m[6], a.m[1], a.m[4], a.m[7], a.m[2], a.m[5], a.m[8]}};
}

Rotation from_columns(Vector3 x, Vector3 y, Vector3 z) {
  return {{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z}};
}

Rotation about(Vector3 axis, double angle_rad) {
  const double s = std::sin(angle_rad), c = std::cos(angle_rad), k = 1.0 - c;
  return {{c + k * axis.x * axis.x, k * axis.x * axis.y - s * axis.z, k * axis.x * axis.z + s * axis.y,
           k * axis.x * axis.y + s * axis.z, c + k * axis.y * axis.y, k * axis.y * axis.z - s * axis.x,
           k * axis.x * axis.z - s * axis.y, k * axis.y * axis.z + s * axis.x, c + k * axis.z * axis.z}};
}

Rotation from_rpy(double roll_rad, double pitch_rad, double yaw_rad) {
  return about({0, 0, 1}, yaw_rad) * about({0, 1, 0}, pitch_rad) * about({1, 0, 0}, roll_rad);
}

Rotation from_quaternion(double w, double x, double y, double z) {
  const double n = 2.0 / (w * w + x * x + y * y + z * z);
  return {{1 - n * (y * y + z * z), n * (x * y - w * z), n * (x * z + w * y), n * (x * y + w * z),
           1 - n * (x * x + z * z), n * (y * z - w * x), n * (x * z - w * y), n * (y * z + w * x),
           1 - n * (x * x + y * y)}};
}

Vector3 rotation_vector(const Rotation& a) {
  // Twice the sine of the angle, along the axis.
  const Vector3 twice_sine{a.m[7] - a.m[5], a.m[2] - a.m[6], a.m[3] - a.m[1]};
  const double sine = 0.5 * length(twice_sine);
  const double cosine = 0.5 * (a.m[0] + a.m[4] + a.m[8] - 1.0);
  const double angle = std::atan2(sine, cosine);
  if (cosine > -0.9) return sine < 1e-12 ? 0.5 * twice_sine : (0.5 * angle / sine) * twice_sine;
  // Near pi the axis is read from the symmetric part, (1 - cos) axis axis^T, whose largest diagonal is best.
  std::size_t best = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (a(k, k) > a(best, best)) best = k;
  Vector3 axis{0.5 * (a(0, best) + a(best, 0)), 0.5 * (a(1, best) + a(best, 1)),
               0.5 * (a(2, best) + a(best, 2))};
  (best == 0 ? axis.x : best == 1 ? axis.y : axis.z) -= cosine;
  axis = normalised(axis);
  return (dot(axis, twice_sine) < 0.0 ? -angle : angle) * axis;
}

double angle_between(const Rotation& a, const Rotation& b) {
  return length(rotation_vector(transposed(a) * b));
}

Transform operator*(const Transform& a, const Transform& b) {
  return {a.rotation * b.rotation, a * b.position_m};
}

Transform inverse(const Transform& a) {
  const Rotation back = transposed(a.rotation);
  return {back, -(back * a.position_m)};
}

}  // namespace stepwright::motion

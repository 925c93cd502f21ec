#include "plant_models/assemblies/robot_cell_space.h"

namespace stepwright::assemblies {

Turn operator*(const Turn& a, const Turn& b) {
  Turn product;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      product.m[3 * row + column] = a.m[3 * row] * b.m[column] + a.m[3 * row + 1] * b.m[3 + column] +
                                    a.m[3 * row + 2] * b.m[6 + column];
    }
  }
  return product;
}

Turn turn_about(Vec3 axis, double angle_rad) {
  const double s = std::sin(angle_rad);
  const double c = std::cos(angle_rad);
  const double rest = 1.0 - c;
  const auto [x, y, z] = axis;
  return {{c + rest * x * x, rest * x * y - s * z, rest * x * z + s * y,  //
           rest * x * y + s * z, c + rest * y * y, rest * y * z - s * x,  //
           rest * x * z - s * y, rest * y * z + s * x, c + rest * z * z}};
}

Turn turn_upright(double yaw_rad) {
  const double s = std::sin(yaw_rad);
  const double c = std::cos(yaw_rad);
  return {{c, -s, 0, s, c, 0, 0, 0, 1}};
}

}  // namespace stepwright::assemblies

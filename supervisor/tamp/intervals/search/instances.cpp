#include "supervisor/tamp/intervals/search/instances.h"

#include <algorithm>
#include <cmath>

namespace stepwright::tamp {

std::vector<Point3> squares_of(const Region& region, double square_m) {
  const auto count = [&](double size_m) {
    return std::max(1, static_cast<int>(std::floor(size_m / square_m + 1e-9)));
  };
  const int across = count(region.size_x_m), along = count(region.size_y_m);
  const double c = std::cos(region.heading_rad), s = std::sin(region.heading_rad);
  std::vector<Point3> squares;
  for (int y = 0; y < along; ++y) {
    for (int x = 0; x < across; ++x) {
      const double off_x = (x + 0.5 - 0.5 * across) * region.size_x_m / across;
      const double off_y = (y + 0.5 - 0.5 * along) * region.size_y_m / along;
      squares.push_back({nanometres_of(region.x_m + c * off_x - s * off_y),
                         nanometres_of(region.y_m + s * off_x + c * off_y), nanometres_of(region.z_m)});
    }
  }
  return squares;
}

std::vector<Angle> angles_of(const Discretisation& how) {
  std::vector<Angle> angles;
  for (std::uint64_t k = 0; k < how.angles; ++k) angles.push_back(static_cast<Angle>((k << 32) / how.angles));
  return angles;
}

}  // namespace stepwright::tamp

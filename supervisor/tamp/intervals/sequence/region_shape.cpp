#include "supervisor/tamp/intervals/sequence/region_shape.h"

#include <cmath>

namespace stepwright::tamp {
namespace {

// More than what the factors' rounding changes at kFarthest_m, in nanometres.
constexpr double kOutward_nm = 1.0;

}  // namespace

RegionShape shape_of(const Region& region) {
  const double c = std::cos(region.heading_rad), s = std::sin(region.heading_rad);
  const double half_x = 0.5 * region.size_x_m, half_y = 0.5 * region.size_y_m;
  if (region.heading_rad == 0.0) {
    return {{nanometres_of(region.x_m - half_x), nanometres_of(region.x_m + half_x)},
            {nanometres_of(region.y_m - half_y), nanometres_of(region.y_m + half_y)},
            {}};
  }
  const double reach_x = std::abs(c) * half_x + std::abs(s) * half_y;
  const double reach_y = std::abs(s) * half_x + std::abs(c) * half_y;
  RegionShape shape{{nanometres_of(region.x_m - reach_x) - 1, nanometres_of(region.x_m + reach_x) + 1},
                    {nanometres_of(region.y_m - reach_y) - 1, nanometres_of(region.y_m + reach_y) + 1},
                    {}};
  const auto side = [&](double x, double y, double half_m) {
    shape.sides.push_back({x, y, 1e9 * (x * region.x_m + y * region.y_m + half_m) + kOutward_nm});
  };
  side(c, s, half_x);
  side(-c, -s, half_x);
  side(-s, c, half_y);
  side(s, -c, half_y);
  return shape;
}

}  // namespace stepwright::tamp

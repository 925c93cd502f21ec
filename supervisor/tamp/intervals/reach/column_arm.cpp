#include "supervisor/tamp/intervals/reach/column_arm.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stepwright::tamp {
namespace {

constexpr double kPi = std::numbers::pi;
// More than the rounding of all that is computed here, in metres and radians.
constexpr double kSlack = 1e-11;

double turn_at(const ColumnArm& arm, double most_rad, double distance_m) {
  if (distance_m <= arm.easy_m) return most_rad;
  return most_rad * std::max(0.0, arm.most_m - distance_m) / (arm.most_m - arm.easy_m);
}

ArcSet turned(const ColumnArm& arm, double low_rad, double high_rad, double distance_m) {
  ArcSet set;
  const double turn = turn_at(arm, arm.turn_rad, distance_m) + kSlack;
  const double lean = arm.lean_rad;
  set.add(arc_outward(low_rad + lean - turn, high_rad + lean + turn));
  if (arm.flip_rad > 0.0) {
    const double flip = turn_at(arm, arm.flip_rad, distance_m) + kSlack;
    set.add(arc_outward(low_rad + lean + kPi - flip, high_rad + lean + kPi + flip));
  }
  return set;
}

// From the nearest to the farthest of |v - middle|, v in [low, high].
struct Away {
  double least = 0.0, most = 0.0;
};
Away away(double low, double high, double middle) {
  const double below = middle - high, above = low - middle;
  return {std::max({0.0, below, above}), std::max(std::abs(low - middle), std::abs(high - middle))};
}

}  // namespace

ArcSet arcs_at(const ColumnArm& arm, const Point3& tool) {
  const double x = metres_of(tool[0]) - arm.x_m, y = metres_of(tool[1]) - arm.y_m;
  const double distance = std::sqrt(x * x + y * y + std::pow(metres_of(tool[2]) - arm.z_m, 2.0));
  if (distance < arm.least_m || distance > arm.most_m) return {};
  const double bearing = std::atan2(y, x);
  return turned(arm, bearing, bearing, distance);
}

ArcSet arcs_over(const ColumnArm& arm, const Box& box) {
  constexpr double kAround_m = 1e-9;
  const auto low = [&](std::size_t axis) { return metres_of(box[axis].low_nm) - kAround_m; };
  const auto high = [&](std::size_t axis) { return metres_of(box[axis].high_nm) + kAround_m; };
  const Away x = away(low(0), high(0), arm.x_m), y = away(low(1), high(1), arm.y_m);
  const Away z = away(low(2), high(2), arm.z_m);
  const auto length = [](double a, double b, double c) { return std::sqrt(a * a + b * b + c * c); };
  const double least = length(x.least, y.least, z.least), most = length(x.most, y.most, z.most);
  if (most < arm.least_m - kSlack || least > arm.most_m + kSlack) return {};
  // Around the shoulder's axis the tool may be on any side.
  if (x.least == 0.0 && y.least == 0.0) return ArcSet::full();
  const double middle = std::atan2(0.5 * (low(1) + high(1)) - arm.y_m, 0.5 * (low(0) + high(0)) - arm.x_m);
  double right = 0.0, left = 0.0;  // of the middle: corners are within half a turn
  for (const double corner_x : {low(0), high(0)}) {
    for (const double corner_y : {low(1), high(1)}) {
      const double off =
          std::remainder(std::atan2(corner_y - arm.y_m, corner_x - arm.x_m) - middle, 2.0 * kPi);
      right = std::min(right, off);
      left = std::max(left, off);
    }
  }
  return turned(arm, middle + right - kSlack, middle + left + kSlack, std::max(least - kSlack, 0.0));
}

ReachTable reach_table(const ColumnArm& arm, double cell_m) {
  ReachGrid grid;
  const std::array middle{arm.x_m, arm.y_m, arm.z_m};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.step_nm[axis] = nanometres_of(cell_m);
    // One cell more than the reach on each side; corners of cells on whole multiples of their width.
    const auto first = static_cast<std::int64_t>(std::floor((middle[axis] - arm.most_m) / cell_m)) - 1;
    const auto last = static_cast<std::int64_t>(std::floor((middle[axis] + arm.most_m) / cell_m)) + 1;
    grid.origin_nm[axis] = first * grid.step_nm[axis];
    grid.cells[axis] = static_cast<std::int32_t>(last - first + 1);
  }
  return ReachTable::fill(grid, [&](const Box& cell) { return arcs_over(arm, cell); });
}

}  // namespace stepwright::tamp

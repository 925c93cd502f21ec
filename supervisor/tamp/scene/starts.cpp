#include "supervisor/tamp/scene/starts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace stepwright::tamp::scene {

namespace {

// Of what a body stands on, if it is below it.
std::optional<double> gap_down_m(const Upright& upper, const Upright& lower) {
  if (gap(upper, lower) >= 0.0 || lower.high_m > upper.low_m + kTouch_m) return std::nullopt;
  return std::max(0.0, upper.low_m - lower.high_m);
}

}  // namespace

std::vector<StartOverlap> overlaps_of(const RobotCell& cell) {
  std::vector<StartOverlap> found;
  for (std::size_t k = 0; k < cell.things.size(); ++k) {
    const Upright body = standing(cell.things[k].form, cell.things[k].start);
    for (const Furniture& each : cell.furniture)
      if (meet(body, standing(each.form, each.pose), 0.0)) found.push_back({k, each.name});
    for (std::size_t other = 0; other < k; ++other)
      if (meet(body, standing(cell.things[other].form, cell.things[other].start), 0.0))
        found.push_back({k, cell.things[other].name});
  }
  return found;
}

double above_ground_m(const RobotCell& cell, std::size_t thing) {
  const Upright body = standing(cell.things[thing].form, cell.things[thing].start);
  double least_m = body.low_m > kTouch_m ? std::numeric_limits<double>::infinity() : 0.0;
  const auto stand = [&](const Form& form, const Pose& pose) {
    if (const auto gap_m = gap_down_m(body, standing(form, pose))) least_m = std::min(least_m, *gap_m);
  };
  for (const Furniture& each : cell.furniture) stand(each.form, each.pose);
  for (std::size_t k = 0; k < cell.things.size(); ++k)
    if (k != thing) stand(cell.things[k].form, cell.things[k].start);
  for (const Surface& each : cell.surfaces)
    stand({.round = false, .size_x_m = each.size_x_m, .size_y_m = each.size_y_m}, each.middle);
  return least_m;
}

bool starts_on(const RobotCell& cell, std::size_t thing, const std::string& place) {
  constexpr double kNear_m = 0.005;
  const Thing& it = cell.things[thing];
  if (const int carrier = cell.thing(place); carrier >= 0) {
    const Thing& below = cell.things[static_cast<std::size_t>(carrier)];
    const Upright upper = standing(it.form, it.start), lower = standing(below.form, below.start);
    return gap(upper, lower) < 0.0 && std::abs(upper.low_m - lower.high_m) < kNear_m;
  }
  const int surface = cell.surface(place);
  if (surface < 0) return false;
  const Surface& on = cell.surfaces[static_cast<std::size_t>(surface)];
  const Form point{.round = true, .radius_m = 0.0, .height_m = it.form.height_m};
  return std::abs(it.start.z_m - on.middle.z_m) < kNear_m && lies_within(on, point, it.start, kNear_m);
}

}  // namespace stepwright::tamp::scene

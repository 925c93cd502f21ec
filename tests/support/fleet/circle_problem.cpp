#include "tests/support/fleet/circle_problem.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "tests/support/fleet/split_mix.h"

namespace stepwright::support {

namespace {

using Points = std::array<int, kCirclePoints>;

Points shuffled(SplitMix64& random) {
  Points points{};
  std::iota(points.begin(), points.end(), 0);
  for (std::size_t k = points.size() - 1; k > 0; --k) std::swap(points[k], points[random.below(k + 1)]);
  return points;
}

bool somebody_stays(const Points& starts, const Points& goals, std::size_t vehicles) {
  for (std::size_t k = 0; k < vehicles; ++k) {
    if (starts[k] == goals[k]) return true;
  }
  return false;
}

}  // namespace

geometry::Pose CirclePose::pose() const {
  const double angle = 2.0 * std::numbers::pi * point / kCirclePoints;
  return {25.0 + 20.0 * std::cos(angle), 25.0 + 20.0 * std::sin(angle),
          std::remainder(2.0 * std::numbers::pi * heading / kCircleHeadings, 2.0 * std::numbers::pi)};
}

fleet::OccupancyGrid circle_floor() {
  return fleet::OccupancyGrid({.resolution_m = 0.2, .origin = {0, 0}, .columns = 250, .rows = 250});
}

std::vector<CircleTask> circle_problem(int vehicles, int run) {
  SplitMix64 random(10'000u * static_cast<std::uint64_t>(vehicles) + static_cast<std::uint64_t>(run));
  const auto count = static_cast<std::size_t>(vehicles);
  const Points starts = shuffled(random);
  Points goals = shuffled(random);
  while (somebody_stays(starts, goals, count)) goals = shuffled(random);
  std::vector<CircleTask> tasks;
  for (std::size_t k = 0; k < count; ++k) {
    const int leaving = static_cast<int>(random.below(kCircleHeadings));
    const int arriving = static_cast<int>(random.below(kCircleHeadings));
    tasks.push_back({{starts[k], leaving}, {goals[k], arriving}});
  }
  return tasks;
}

}  // namespace stepwright::support

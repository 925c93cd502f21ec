#include "supervisor/ltl/guide/corridor.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "supervisor/ltl/guide/task.h"
#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using geometry::Point;

std::size_t side_between(const RegionMap& map, std::uint32_t from, std::uint32_t to) {
  const auto& across = map.region(from).across;
  return static_cast<std::size_t>(std::find(across.begin(), across.end(), to) - across.begin());
}

// The shortest way over points of each side, by dynamic programming; no shorter than the true one.
double sampled_m(const RegionMap& map, const std::vector<Stage>& stages, Point from) {
  constexpr int kSamples = 400;
  std::vector<std::pair<Point, double>> reached = {{from, 0.0}};
  for (std::size_t k = 0; k + 1 < stages.size(); ++k) {
    const std::size_t side = side_between(map, stages[k].region, stages[k + 1].region);
    const Point a = map.corner(stages[k].region, side), b = map.corner(stages[k].region, side + 1);
    std::vector<std::pair<Point, double>> next;
    for (int i = 0; i <= kSamples; ++i) {
      const Point at = a + (static_cast<double>(i) / kSamples) * (b - a);
      double best = std::numeric_limits<double>::infinity();
      for (const auto& [point, way_m] : reached) best = std::min(best, way_m + geometry::distance(point, at));
      next.emplace_back(at, best);
    }
    reached = std::move(next);
  }
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [point, way_m] : reached) best = std::min(best, way_m);
  return best;
}

struct Found {
  RegionMap map;
  std::vector<Stage> stages;
  Point from;
};

// Ways to the last place of random floors.
std::vector<Found> random_ways(std::uint32_t first, std::uint32_t last) {
  std::vector<Found> all;
  for (std::uint32_t seed = first; seed < last; ++seed) {
    const Floor floor = testing::random_squares(seed).floor();
    if (floor.propositions.empty()) continue;
    auto map = make_regions(floor);
    if (!map) continue;
    std::vector<std::string> names;
    for (const Area& each : floor.propositions) names.push_back(each.name);
    const auto task = read_task("visit " + names.back(), names);
    const Guide guide(*map, task->automaton);
    for (std::uint32_t region = 0; region < map->regions().size(); region += 9) {
      auto stages = guide.way(region, guide.start(region));
      if (stages.size() > 1) all.push_back({*map, std::move(stages), map->centroid(region)});
    }
  }
  return all;
}

TEST(Corridor, WhenThereIsNoMargin_ThenTheWayIsAsShortAsSamplesOfAllSidesAllow) {
  const auto ways = random_ways(1, 25);
  ASSERT_GT(ways.size(), 40u);
  for (std::size_t k = 0; k < ways.size(); k += 3) {
    const Found& found = ways[k];
    const double sampled = sampled_m(found.map, found.stages, found.from);
    const double told = length_m(Corridor(found.map).way(found.stages, found.from));
    EXPECT_LE(told, sampled + 1e-9);
    EXPECT_GE(told, sampled - 0.02 * (1.0 + sampled));
  }
}

TEST(Corridor, WhenAMarginIsKept_ThenCornersOfWallsAreThatFarAndTheWayIsNoShorter) {
  int bends = 0;
  for (const Found& found : random_ways(30, 60)) {
    const Corridor corridor(found.map);
    const auto tight = corridor.way(found.stages, found.from);
    const auto wide = corridor.way(found.stages, found.from, 0.3);
    EXPECT_EQ(wide.front(), found.from);
    EXPECT_GE(length_m(wide), length_m(tight) - 1e-9);
    for (std::size_t k = 1; k + 1 < wide.size(); ++k) {
      // A bend lies on a side, 0.3 m from its end, unless the side is narrower than twice that.
      for (const Point& point : found.map.points()) {
        const double away = geometry::distance(point, wide[k]);
        if (away < 0.3 - 1e-9) ++bends;
      }
    }
  }
  EXPECT_LT(bends, 60) << "narrow sides only";
}

TEST(Corridor, WhenThereIsOneRegionOnly_ThenThereIsNoWayToGo) {
  const Floor floor = testing::random_squares(3).floor();
  const auto map = make_regions(floor);
  ASSERT_TRUE(map);
  const std::vector<Stage> stages = {{0, 0}};
  EXPECT_EQ(Corridor(*map).way(stages, {1.0, 1.0}), (std::vector<Point>{{1.0, 1.0}}));
}

}  // namespace
}  // namespace stepwright::ltl

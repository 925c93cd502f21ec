#include "supervisor/ltl/train/walls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using geometry::Point;

LinkBox box_at(const geometry::Pose& pose) {
  return {pose.position(), {std::cos(pose.heading_rad), std::sin(pose.heading_rad)}};
}

// Whether the segment comes into the box: a polygon of its ends and a point so near that it is one.
bool meets_slowly(Point from, Point to, const geometry::ConvexPolygon& box) {
  constexpr int kPieces = 2000;
  for (int k = 0; k <= kPieces; ++k)
    if (box.contains(from + (static_cast<double>(k) / kPieces) * (to - from), -1e-6)) return true;
  return false;
}

TEST(Walls, WhenBoxesAreAnywhere_ThenTheyMeetWhatSamplesOfTheSidesMeet) {
  std::mt19937 dice(11);
  std::uniform_real_distribution<double> place(-1.0, testing::kSize + 1.0), angle(-3.2, 3.2);
  const TrainModel model{.length_m = 1.3, .width_m = 0.4};
  int met = 0, doubtful = 0;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const Floor floor = testing::random_squares(seed).floor();
    const Walls walls(floor, model);
    std::vector<std::vector<Point>> rings = {floor.border.ring};
    for (const Area& each : floor.obstacles) rings.push_back(each.ring);
    for (int round = 0; round < 60; ++round) {
      const geometry::Pose pose{place(dice), place(dice), angle(dice)};
      const auto shape = footprint_at(pose, {0.65, 0.65, 0.2});
      bool expected = false;
      for (const auto& ring : rings)
        for (std::size_t k = 0; k < ring.size() && !expected; ++k)
          expected = meets_slowly(ring[k], ring[(k + 1) % ring.size()], shape);
      const bool told = walls.meets(box_at(pose));
      // Samples may miss a corner that is cut by less than their distance.
      if (told && !expected) ++doubtful;
      EXPECT_TRUE(told || !expected) << seed << " " << pose.x_m << " " << pose.y_m;
      met += expected ? 1 : 0;
    }
  }
  EXPECT_GT(met, 100);
  EXPECT_LE(doubtful, 3);
}

TEST(Walls, WhenASideOnlyTouches_ThenItIsNotMet) {
  Floor floor;
  floor.border = testing::Rectangle{0, 0, 20, 20}.area("border");
  const Walls walls(floor, {.length_m = 2.0, .width_m = 1.0});
  EXPECT_FALSE(walls.meets(box_at({1.0, 0.5, 0.0})));
  EXPECT_TRUE(walls.meets(box_at({0.999, 0.5, 0.0})));
  EXPECT_TRUE(walls.meets(box_at({1.0, 0.499, 0.0})));
}

TEST(Walls, WhenAskedHowFarTheyAre_ThenNoneIsNearer) {
  std::mt19937 dice(13);
  std::uniform_real_distribution<double> place(0.0, testing::kSize);
  const Floor floor = testing::random_squares(4).floor();
  const Walls walls(floor, {});
  std::vector<std::vector<Point>> rings = {floor.border.ring};
  for (const Area& each : floor.obstacles) rings.push_back(each.ring);
  double widest = 0.0;
  for (int round = 0; round < 2000; ++round) {
    const Point at{place(dice), place(dice)};
    double nearest = 1e9;
    for (const auto& ring : rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point from = ring[k], along = ring[(k + 1) % ring.size()] - from;
        const double share = std::min(1.0, std::max(0.0, dot(at - from, along) / dot(along, along)));
        nearest = std::min(nearest, geometry::distance(at, from + share * along));
      }
    }
    EXPECT_LE(walls.clearance_m(at), nearest);
    EXPECT_GE(walls.clearance_m(at), nearest - 0.5);  // a cell's diagonal, twice
    widest = std::max(widest, walls.clearance_m(at));
  }
  EXPECT_GT(widest, 1.0);
  EXPECT_EQ(walls.clearance_m({-1.0, 5.0}), 0.0);
}

}  // namespace
}  // namespace stepwright::ltl

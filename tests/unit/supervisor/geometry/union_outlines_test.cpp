#include "supervisor/geometry/union_outlines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace stepwright::geometry {
namespace {

using Outlines = std::vector<std::vector<Point>>;

ConvexPolygon box(double x, double y, double width, double height) {
  const std::vector<Point> corners = {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
  return *ConvexPolygon::hull(corners);
}

double area_of(const std::vector<Point>& ring) {
  double twice = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) twice += cross(ring[k], ring[(k + 1) % ring.size()]);
  return twice / 2.0;
}

// How often the outlines run around the point: what the nonzero rule fills.
int winding(const Outlines& outlines, Point p) {
  int turns = 0;
  for (const auto& ring : outlines) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point a = ring[k], b = ring[(k + 1) % ring.size()];
      if (a.y_m <= p.y_m && b.y_m > p.y_m && cross(b - a, p - a) > 0) ++turns;
      if (a.y_m > p.y_m && b.y_m <= p.y_m && cross(b - a, p - a) < 0) --turns;
    }
  }
  return turns;
}

double distance_to(const Outlines& outlines, Point p) {
  double least = 1e9;
  for (const auto& ring : outlines) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point a = ring[k], b = ring[(k + 1) % ring.size()];
      const double along = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
      least = std::min(least, distance(p, a + along * (b - a)));
    }
  }
  return least;
}

TEST(UnionOutlines, WhenRegionsOverlap_ThenTheyHaveOneOutline) {
  const std::vector<ConvexPolygon> regions = {box(0, 0, 2, 1), box(1, 0, 2, 1), box(2, 0, 1, 3)};
  const auto outlines = union_outlines(regions, 0.01);
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_EQ(outlines[0].size(), 6u);
  EXPECT_NEAR(area_of(outlines[0]), 3.0 + 2.0, 1e-9);
}

TEST(UnionOutlines, WhenRegionsAreApart_ThenEachHasItsOwn) {
  const std::vector<ConvexPolygon> regions = {box(0, 0, 1, 1), box(3, 0, 1, 1)};
  EXPECT_EQ(union_outlines(regions, 0.01).size(), 2u);
  EXPECT_TRUE(union_outlines({}, 0.01).empty());
}

TEST(UnionOutlines, WhenTheyLieAroundAHole_ThenItsOutlineRunsClockwise) {
  const std::vector<ConvexPolygon> regions = {box(0, 0, 5, 1), box(0, 4, 5, 1), box(0, 0, 1, 5),
                                              box(4, 0, 1, 5)};
  const auto outlines = union_outlines(regions, 0.01);
  ASSERT_EQ(outlines.size(), 2u);
  EXPECT_NEAR(area_of(outlines[0]), 25.0, 1e-9);
  EXPECT_NEAR(area_of(outlines[1]), -9.0, 1e-9);
}

// As critical sections are: slender pieces that follow each other, nearly the same ones among them.
TEST(UnionOutlines, WhenManyPiecesFollowACurve_ThenTheOutlineCoversWhatTheyDo) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.004, 0.004), place(-9.0, 9.0);
  std::vector<ConvexPolygon> regions;
  for (int k = 0; k < 240; ++k) {
    const double angle = 1.9 * std::numbers::pi * (k / 3) / 80.0 + jitter(random);
    regions.push_back(footprint_at({6.0 * std::cos(angle), 6.0 * std::sin(angle), angle + 1.57},
                                   {.front_m = 1.6, .rear_m = 1.2 + jitter(random), .half_width_m = 0.7}));
  }
  constexpr double kTolerance_m = 0.01;
  const auto outlines = union_outlines(regions, kTolerance_m);
  std::size_t corners = 0;
  for (const auto& ring : outlines) corners += ring.size();
  EXPECT_LT(corners, 500u);  // of 960; those left are teeth of the outer edge
  for (int k = 0; k < 4'000; ++k) {
    const Point p{place(random), place(random)};
    if (distance_to(outlines, p) < 1.5 * kTolerance_m) continue;
    bool inside = false;
    for (const ConvexPolygon& region : regions) inside = inside || region.contains(p);
    ASSERT_EQ(winding(outlines, p) != 0, inside) << p.x_m << " " << p.y_m;
  }
}

}  // namespace
}  // namespace stepwright::geometry

#include "supervisor/geometry/convex_polygon.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace stepwright::geometry {
namespace {

ConvexPolygon rectangle(double x0, double y0, double x1, double y1) {
  const std::array<Point, 4> corners = {Point{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  return ConvexPolygon::hull(corners).value();
}

ConvexPolygon random_polygon(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  std::uniform_real_distribution<double> offset(-1.5, 1.5);
  const Point middle{place(random), place(random)};
  std::vector<Point> points;
  for (int k = 0; k < 8; ++k) points.push_back(middle + Point{offset(random), offset(random)});
  return ConvexPolygon::hull(points).value();
}

TEST(ConvexPolygon, Hull_WhenPointsLieInsideOrOnSides_ThenOnlyCornersAreKept) {
  const std::array<Point, 7> points = {Point{1, 1}, {0, 0}, {2, 0}, {1, 0}, {2, 2}, {0, 2}, {0, 2}};
  const auto polygon = ConvexPolygon::hull(points);
  ASSERT_TRUE(polygon.has_value());
  EXPECT_EQ(polygon->corners().size(), 4u);
  EXPECT_DOUBLE_EQ(polygon->area_m2(), 4.0);
  EXPECT_EQ(polygon->centroid(), (Point{1.0, 1.0}));
}

TEST(ConvexPolygon, Hull_WhenThereIsNoArea_ThenNothing) {
  const std::array<Point, 3> line = {Point{0, 0}, {1, 1}, {2, 2}};
  const std::array<Point, 3> endless = {Point{0, 0}, {1, 0}, {0, std::numeric_limits<double>::infinity()}};
  EXPECT_FALSE(ConvexPolygon::hull(line).has_value());
  EXPECT_FALSE(ConvexPolygon::hull(endless).has_value());
  EXPECT_FALSE(ConvexPolygon::hull({}).has_value());
}

TEST(ConvexPolygon, Overlaps_WhenTheyOnlyTouch_ThenNo) {
  const auto square = rectangle(0, 0, 1, 1);
  EXPECT_FALSE(overlaps(square, rectangle(1, 0, 2, 1)));
  EXPECT_FALSE(overlaps(square, rectangle(1, 1, 2, 2)));
  EXPECT_TRUE(overlaps(square, rectangle(0.999, 0.999, 2, 2)));
  EXPECT_TRUE(overlaps(square, rectangle(0.2, 0.2, 0.4, 0.4)));
}

// Each result is held against a count of random points: they lie in the intersection if and only if in both.
TEST(ConvexPolygon, Intersection_WhenPolygonsAreRandom_ThenHoldsWhatBothContain) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-4.5, 4.5);
  int overlapping = 0;
  for (int round = 0; round < 400; ++round) {
    const auto a = random_polygon(random);
    const auto b = random_polygon(random);
    const auto both = intersection(a, b);
    EXPECT_EQ(both.has_value(), overlaps(a, b));
    EXPECT_EQ(overlaps(a, b), overlaps(b, a));
    if (both) {
      ++overlapping;
      EXPECT_TRUE(a.contains(*both, 1e-9) && b.contains(*both, 1e-9));
    }
    for (int k = 0; k < 50; ++k) {
      const Point p{place(random), place(random)};
      EXPECT_EQ(a.contains(p) && b.contains(p), both && both->contains(p)) << round;
    }
  }
  EXPECT_GT(overlapping, 50);
  EXPECT_LT(overlapping, 350);
}

TEST(ConvexPolygon, HalfPlanes_WhenAPointIsInside_ThenAllOfThemHold) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-4.5, 4.5);
  for (int round = 0; round < 200; ++round) {
    const auto polygon = random_polygon(random);
    const Point p{place(random), place(random)};
    bool inside = true;
    for (const auto& side : polygon.half_planes()) {
      EXPECT_NEAR(std::hypot(side.normal.x_m, side.normal.y_m), 1.0, 1e-12);
      inside = inside && dot(side.normal, p) <= side.offset_m;
    }
    EXPECT_EQ(inside, polygon.contains(p));
  }
}

TEST(ConvexPolygon, FootprintAt_WhenTheVehicleIsTurned_ThenItsCornersTurnWithIt) {
  const auto box =
      footprint_at({10.0, 5.0, std::acos(-1.0) / 2.0}, {.front_m = 3.0, .rear_m = 1.0, .half_width_m = 0.7});
  EXPECT_NEAR(box.bounds().low.x_m, 9.3, 1e-12);
  EXPECT_NEAR(box.bounds().high.x_m, 10.7, 1e-12);
  EXPECT_NEAR(box.bounds().low.y_m, 4.0, 1e-12);
  EXPECT_NEAR(box.bounds().high.y_m, 8.0, 1e-12);
  EXPECT_NEAR(box.area_m2(), 4.0 * 1.4, 1e-12);
}

}  // namespace
}  // namespace stepwright::geometry

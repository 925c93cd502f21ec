#include "plant_models/assemblies/floor_polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "plant_models/core/counter_random.h"

namespace stepwright::assemblies {
namespace {

using body2d::Vec2;

PlacedBox box_at(double x, double y, double angle = 0.0, double length = 2.0, double width = 1.0) {
  return {{x, y}, {std::cos(angle), std::sin(angle)}, 0.5 * length, 0.5 * width};
}

// Like an L: the upper right quarter is missing.
const std::vector<Vec2> kAngle = {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};

TEST(FloorPolygon, WhenABoxMeetsAnOutline_ThenInnerPointsDecide) {
  const FloorOutline outline(kAngle);
  EXPECT_FALSE(meets(box_at(3.0, 3.0), outline, Solid::Inside));  // in the missing quarter
  EXPECT_TRUE(meets(box_at(2.9, 3.0), outline, Solid::Inside));
  EXPECT_FALSE(meets(box_at(5.0, 1.0), outline, Solid::Inside));  // touches a side
  EXPECT_TRUE(meets(box_at(5.0 - 1e-6, 1.0), outline, Solid::Inside));
  EXPECT_TRUE(meets(box_at(1.0, 1.0, 0.0, 0.1, 0.1), outline, Solid::Inside));  // within
  EXPECT_TRUE(meets(box_at(2.0, 2.0, 0.3, 9.0, 9.0), outline, Solid::Inside));  // around
  EXPECT_FALSE(meets(box_at(3.2, 3.2, std::numbers::pi / 4.0), outline, Solid::Inside));
  EXPECT_TRUE(meets(box_at(2.7, 2.7, std::numbers::pi / 4.0), outline, Solid::Inside));
}

TEST(FloorPolygon, WhenAnOutlineIsTheWallAround_ThenItsInsideIsFree) {
  const FloorOutline outline(kAngle);
  EXPECT_FALSE(meets(box_at(1.0, 1.0, 0.0, 2.0, 2.0), outline, Solid::Outside));
  EXPECT_TRUE(meets(box_at(1.0, 1.0, 0.1, 2.0, 2.0), outline, Solid::Outside));
  EXPECT_TRUE(meets(box_at(3.0, 3.0, 0.0, 0.1, 0.1), outline, Solid::Outside));
  EXPECT_TRUE(meets(box_at(50.0, 3.0), outline, Solid::Outside));
}

TEST(FloorPolygon, WhenBoxesAreTurned_ThenTheyMeetOnlyWhereTheyOverlap) {
  EXPECT_FALSE(meets(box_at(0, 0), box_at(2.0, 0.0)));
  EXPECT_TRUE(meets(box_at(0, 0), box_at(1.999, 0.0)));
  // A corner that points at the side.
  const double half_m = 0.5 * std::hypot(2.0, 1.0);
  const double angle = std::numbers::pi / 2.0 - std::atan2(1.0, 2.0);
  EXPECT_FALSE(meets(box_at(0, 0), box_at(0.0, 0.5 + half_m + 1e-6, angle)));
  EXPECT_TRUE(meets(box_at(0, 0), box_at(0.0, 0.5 + half_m - 1e-6, angle)));
}

TEST(FloorPolygon, WhenABoxIsFree_ThenItsDistanceIsThatOfTheNearestPoints) {
  const FloorOutline outline(kAngle);
  EXPECT_DOUBLE_EQ(distance_m(box_at(6.0, 1.0), outline, 10.0), 1.0);
  EXPECT_DOUBLE_EQ(distance_m(box_at(6.0, 1.0), outline, 0.5), 0.5);  // no less than that
  EXPECT_DOUBLE_EQ(distance_m(box_at(3.5, 3.0), outline, 10.0), 0.5);
  EXPECT_NEAR(distance_m(box_at(8.0, 5.5), outline, 10.0), std::hypot(3.0, 3.0), 1e-12);
  EXPECT_NEAR(distance_m(box_at(1.0, 1.0, 0.0, 1.0, 1.0), outline, 10.0), 0.5, 1e-12);  // from within
}

// Points of a fine grid as the truth, for boxes and triangles that lie anyhow.
TEST(FloorPolygon, WhenThereAreManyBoxes_ThenSampledPointsAgree) {
  const core::CounterRandom random(7, 1);
  std::uint64_t draw = 0;
  const auto number = [&](double most) { return most * random.symmetric(draw++); };
  int met = 0;
  for (int k = 0; k < 300; ++k) {
    const FloorOutline outline({{number(3), number(3)}, {number(3), number(3)}, {number(3), number(3)}});
    const PlacedBox box = box_at(number(3), number(3), number(4));
    bool shares = false;
    for (int i = -19; i < 20 && !shares; ++i) {
      for (int j = -19; j < 20 && !shares; ++j) {
        const Vec2 aside{-box.ahead.y, box.ahead.x};
        shares = outline.contains(box.middle + (i * box.half_length_m / 20.0) * box.ahead +
                                  (j * box.half_width_m / 20.0) * aside);
      }
    }
    if (shares) {
      ASSERT_TRUE(meets(box, outline, Solid::Inside)) << k;
      ++met;
    } else if (distance_m(box, outline, 9.0) > 0.1) {
      ASSERT_FALSE(meets(box, outline, Solid::Inside)) << k;
    }
  }
  EXPECT_GT(met, 50);
  EXPECT_LT(met, 250);
}

TEST(FloorPolygon, WhenAnOutlineIsNotSimple_ThenItIsRefused) {
  EXPECT_TRUE(is_simple(kAngle));
  EXPECT_FALSE(is_simple({{0, 0}, {1, 0}}));
  EXPECT_FALSE(is_simple({{0, 0}, {2, 2}, {2, 0}, {0, 2}}));  // crosses itself
  EXPECT_FALSE(is_simple({{0, 0}, {4, 0}, {4, 4}, {2, 0}}));  // touches itself
  EXPECT_FALSE(is_simple({{0, 0}, {1, 0}, {2, 0}}));          // has no area
  EXPECT_FALSE(is_simple({{0, 0}, {3, 0}, {1, 0}, {1, 1}}));  // goes back
  EXPECT_FALSE(is_simple({{0, 0}, {1, 0}, {1, 0}, {0, 1}}));  // a corner twice
  EXPECT_FALSE(is_simple({{0, 0}, {1, 0}, {0, std::nan("")}}));
}

}  // namespace
}  // namespace stepwright::assemblies

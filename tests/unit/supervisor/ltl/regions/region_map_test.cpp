#include "supervisor/ltl/regions/region_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "floors.h"

namespace stepwright::ltl {
namespace {

TEST(RegionMap, Neighbours_WhenFloorsAreRandom_ThenShareTheSideInBothDirections) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const auto map = make_regions(testing::random_squares(seed).floor());
    ASSERT_TRUE(map.has_value());
    for (std::uint32_t i = 0; i < map->regions().size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t across = map->region(i).across[k];
        if (across == kNoRegion) continue;
        const Region& there = map->region(across);
        const auto back = std::ranges::find(there.across, i) - there.across.begin();
        ASSERT_LT(back, 3);
        EXPECT_EQ(there.corners[static_cast<std::size_t>(back)], map->region(i).corners[(k + 1) % 3]);
        EXPECT_EQ(there.corners[static_cast<std::size_t>(back + 1) % 3], map->region(i).corners[k]);
      }
    }
  }
}

TEST(RegionMap, Locate_WhenThePointIsOutsideOrNoNumber_ThenFindsNothing) {
  const RegionMap map({{0, 0}, {4, 0}, {0, 4}}, {{.corners = {0, 1, 2}}});
  EXPECT_EQ(map.locate({1, 1}), 0U);
  EXPECT_EQ(map.locate({2, 2}), 0U);  // on the side
  EXPECT_EQ(map.locate({2.1, 2}), kNoRegion);
  EXPECT_EQ(map.locate({-1, 1}), kNoRegion);
  EXPECT_EQ(map.locate({1, 1e300}), kNoRegion);
  EXPECT_EQ(map.locate({std::numeric_limits<double>::quiet_NaN(), 1}), kNoRegion);
}

TEST(RegionMap, Map_WhenItHasNoRegions_ThenLocatesNothing) {
  const RegionMap map({}, {});
  EXPECT_EQ(map.locate({0, 0}), kNoRegion);
  EXPECT_EQ(map.area_m2(), 0.0);
}

}  // namespace
}  // namespace stepwright::ltl

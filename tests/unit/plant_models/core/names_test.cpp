#include "plant_models/core/names.h"

#include <gtest/gtest.h>

#include <vector>

#include "plant_models/core/port.h"

namespace stepwright::core {
namespace {

TEST(Names, WhenOnlyCaseDiffers_ThenSame) {
  EXPECT_TRUE(same_name("Drive_Left", "drive_LEFT"));
  EXPECT_FALSE(same_name("B1", "B2"));
  EXPECT_FALSE(same_name("B1", "B"));
  EXPECT_FALSE(same_name("[", "{"));  // letters only
}

TEST(Names, WhenSearched_ThenIndexOrNothing) {
  const std::vector<Quantity> list = {{"leak_a1", "", ""}, {"weak_b1", "", ""}};
  EXPECT_EQ(index_of(list, "WEAK_B1"), 1u);
  EXPECT_EQ(index_of(list, "weak"), std::nullopt);
  EXPECT_EQ(joined_names(list), "leak_a1, weak_b1");
}

TEST(Names, WhenThereAreMany_ThenTheNearestAreNamed) {
  std::vector<Quantity> list;
  for (const char* kind : {"stuck_left_", "runaway_left_", "stuck_right_", "runaway_right_"})
    for (int k = 1; k <= 7; ++k) list.push_back({kind + std::to_string(k), "", ""});
  const std::string known = known_names(list, "stuck_rigt_1");
  EXPECT_EQ(known.substr(0, 27), "the nearest: stuck_right_1,") << known;
  EXPECT_NE(known.find("; known: stuck_left_1, "), std::string::npos) << known;
  EXPECT_NE(known.find(", runaway_right_7"), std::string::npos) << known;
  list.resize(2);
  EXPECT_EQ(known_names(list, "x"), "known: stuck_left_1, stuck_left_2");
}

}  // namespace
}  // namespace stepwright::core

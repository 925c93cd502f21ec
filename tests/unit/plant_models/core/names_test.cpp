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

}  // namespace
}  // namespace stepwright::core

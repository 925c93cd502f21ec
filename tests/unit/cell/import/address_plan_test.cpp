#include "cell/import/address_plan.h"

#include <gtest/gtest.h>

namespace stepwright::cell_import {
namespace {

using naming::Area;

TEST(AddressPlan, WhenAnArrayMoves_ThenNothingIsPutIntoIt) {
  const AddressPlan plan({"%QX0.0", "%QW0", "%QW12"}, {{"%QW0", 160}});
  EXPECT_EQ(plan.address("%QW0"), "%QW1");
  EXPECT_EQ(plan.address("%QW12"), "%QW11");
  EXPECT_EQ(plan.bytes(Area::Output), 24u);
}

TEST(AddressPlan, WhenAnAddressLiesInAnArray_ThenItStaysThere) {
  const AddressPlan plan({"%QW3", "%QX0.0", "%QW0", "%QW9"}, {{"%QW0", 160}});
  EXPECT_EQ(plan.address("%QW0"), "%QW1");
  EXPECT_EQ(plan.address("%QW3"), "%QW4");
  EXPECT_EQ(plan.address("%QW9"), "%QW10");
  EXPECT_EQ(plan.bytes(Area::Output), 22u);
}

TEST(AddressPlan, WhenAnArrayReachesBitsOfAnotherSize_ThenTheyAreToldApart) {
  const AddressPlan plan({"%IW0", "%IX4.0"}, {{"%IW0", 64}});
  EXPECT_EQ(plan.address("%IX4.0"), "%IX0.0");
  EXPECT_EQ(plan.address("%IW0"), "%IW1");
  EXPECT_EQ(plan.bytes(Area::Input), 10u);
}

TEST(AddressPlan, WhenAllStay_ThenTheLastArrayIsCounted) {
  const AddressPlan plan({"%QW4", "%QX0.0"}, {{"%QW4", 160}});
  EXPECT_TRUE(plan.moved().empty());
  EXPECT_EQ(plan.bytes(Area::Output), 28u);
}

TEST(AddressPlan, WhenAddressesHaveLevels_ThenAnArrayCountsInItsOwnTable) {
  const AddressPlan plan({"%QW1.0.0", "%QW1.0.2", "%QW1.0.4", "%QW2.0.0"}, {{"%QW1.0.0", 48}});
  EXPECT_EQ(plan.address("%QW1.0.0"), "%QW0");
  EXPECT_EQ(plan.address("%QW1.0.2"), "%QW2");
  EXPECT_EQ(plan.address("%QW1.0.4"), "%QW3");
  EXPECT_EQ(plan.address("%QW2.0.0"), "%QW4");
}

}  // namespace
}  // namespace stepwright::cell_import

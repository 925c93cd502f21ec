#include "runtime/image/force_table.h"

#include <gtest/gtest.h>

#include <vector>

namespace stepwright::image {
namespace {

TEST(ForceTable, Apply_WhenBitsAndWordsAreForced_ThenOnlyTheyChange) {
  std::vector<std::byte> image(8, std::byte{0xF0});
  ForceTable table;
  EXPECT_TRUE(table.set({.address = 0, .bit = 1, .size = 1, .value = 1}, image.size()));
  EXPECT_TRUE(table.set({.address = 0, .bit = 7, .size = 1, .value = 0}, image.size()));
  EXPECT_TRUE(table.set({.address = 2, .size = 2, .value = 0x1234}, image.size()));
  table.apply(image);
  EXPECT_EQ(image[0], std::byte{0x72});
  EXPECT_EQ(image[1], std::byte{0xF0});
  EXPECT_EQ(image[2], std::byte{0x34});
  EXPECT_EQ(image[3], std::byte{0x12});
  EXPECT_EQ(image[4], std::byte{0xF0});
}

TEST(ForceTable, Set_WhenThePlaceIsForcedAlready_ThenReplacesTheValue) {
  std::vector<std::byte> image(1);
  ForceTable table;
  EXPECT_TRUE(table.set({.value = 1}, 1));
  EXPECT_TRUE(table.set({.value = 2}, 1));
  EXPECT_EQ(table.forces().size(), 1u);
  table.apply(image);
  EXPECT_EQ(image[0], std::byte{2});
}

TEST(ForceTable, Set_WhenMalformedOrOutside_ThenIsRefused) {
  ForceTable table;
  EXPECT_FALSE(table.set({.address = 7, .size = 2}, 8));
  EXPECT_FALSE(table.set({.address = 0xFFFFFFFF, .size = 8}, 8));
  EXPECT_FALSE(table.set({.address = 0, .size = 3}, 8));
  EXPECT_FALSE(table.set({.address = 0, .bit = 8, .size = 1}, 8));
  EXPECT_FALSE(table.set({.address = 0, .bit = 0, .size = 2}, 8));
  EXPECT_TRUE(table.forces().empty());
}

TEST(ForceTable, Set_WhenFull_ThenIsRefusedUntilOneIsCleared) {
  ForceTable table;
  for (std::uint32_t i = 0; i < ForceTable::kCapacity; ++i) EXPECT_TRUE(table.set({.address = i}, 1000));
  EXPECT_FALSE(table.set({.address = 900}, 1000));
  EXPECT_FALSE(table.clear(900, kWholeBytes));
  EXPECT_TRUE(table.clear(3, kWholeBytes));
  EXPECT_TRUE(table.set({.address = 900}, 1000));
  EXPECT_EQ(table.forces()[3].address, 4u);
  table.clear_all();
  EXPECT_TRUE(table.forces().empty());
}

}  // namespace
}  // namespace stepwright::image

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

TEST(ForceTable, TakeEnded_WhenTimesAreOver_ThenEachIsTakenOutOnceAndTheRestStays) {
  ForceTable table;
  Force ended;
  EXPECT_EQ(table.next_end_ns(), kNoEnd);
  ASSERT_TRUE(table.set({.address = 1, .end_ns = 300}, 100));
  ASSERT_TRUE(table.set({.address = 2}, 100));
  ASSERT_TRUE(table.set({.address = 3, .end_ns = 200}, 100));
  EXPECT_EQ(table.next_end_ns(), 200);
  EXPECT_FALSE(table.take_ended(199, ended));
  ASSERT_TRUE(table.take_ended(200, ended));
  EXPECT_EQ(ended.address, 3u);
  EXPECT_FALSE(table.take_ended(200, ended));
  ASSERT_TRUE(table.set({.address = 1, .end_ns = 900}, 100)) << "the newest end counts";
  EXPECT_FALSE(table.take_ended(300, ended));
  ASSERT_TRUE(table.take_ended(kNoEnd - 1, ended));
  EXPECT_FALSE(table.take_ended(kNoEnd, ended)) << "what has no end has none ever";
  ASSERT_EQ(table.forces().size(), 1u);
  EXPECT_EQ(table.forces()[0].address, 2u);
}

}  // namespace
}  // namespace stepwright::image

#include "hmi_web/server/array_selection.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stepwright::server {
namespace {

class ArraySelectionTest : public testing::Test {
 protected:
  static std::string element(const std::string& array, int i) {
    return array + "[" + std::to_string(i) + "]";
  }
  // `count` blocks with `members` variables each.
  void add_blocks(const std::string& array, int count, int members) {
    for (int i = 1; i <= count; ++i) {
      instances_.push_back({element(array, i), "Pump"});
      for (int m = 0; m < members; ++m) add(element(array, i) + ".m" + std::to_string(m));
    }
  }
  void add_values(const std::string& array, int count) {
    for (int i = 1; i <= count; ++i) add(element(array, i));
  }
  void add(const std::string& name) { tags_.push_back({name, {}, 0}); }
  ArraySelection made() const { return ArraySelection(tags_, instances_); }

  std::vector<reader::Tag> tags_;
  std::vector<reader::InstanceInfo> instances_ = {{"Main", "Main"}};
};

TEST_F(ArraySelectionTest, WhenAnArrayIsOfFunctionBlocks_ThenEveryValueIsShown) {
  add_blocks("Main.p", 40, 5);
  add_blocks("Main.many", 1'000, 6);
  const auto selection = made();
  EXPECT_TRUE(selection.left_out().empty());
  for (const reader::Tag& tag : tags_) EXPECT_TRUE(selection.shows(tag.name)) << tag.name;
  EXPECT_TRUE(selection.shows("Main.speed"));
}

TEST_F(ArraySelectionTest, WhenAnArrayOfBlocksHasTwoDimensionsOrStandsInAStructure_ThenItIsShown) {
  for (int i = 1; i <= 300; ++i) {
    for (const std::string& path : {element("Main.p[1]", i), element("Main.s", i) + ".pump"}) {
      instances_.push_back({path, "Pump"});
      add(path + ".speed");
    }
  }
  const auto selection = made();
  EXPECT_TRUE(selection.shows("Main.p[1][300].speed"));
  EXPECT_TRUE(selection.shows("Main.s[300].pump.speed"));
}

TEST_F(ArraySelectionTest, WhenAnArrayIsATable_ThenItIsLeftOutAndNamed) {
  add_values("Main.short", 256);
  add_values("Main.table", 257);
  for (int i = 1; i <= 300; ++i) add(element("path", i) + ".x");
  add_blocks("Main.p", 2, 3);
  add_values("Main.p[2].curve", 400);
  const auto selection = made();
  EXPECT_TRUE(selection.shows("Main.short[256]"));
  EXPECT_TRUE(selection.shows("Main.p[2].m1"));
  for (const char* tag : {"Main.table[1]", "path[7].x", "Main.p[2].curve[9]"})
    EXPECT_FALSE(selection.shows(tag)) << tag;
  const auto left_out = selection.left_out();
  ASSERT_EQ(left_out.size(), 3u);
  EXPECT_EQ(left_out[0].name, "Main.table");
  EXPECT_EQ(left_out[0].values, 257u);
  EXPECT_FALSE(left_out[0].of_blocks);
  EXPECT_EQ(left_out[2].name, "Main.p[2].curve");
}

TEST_F(ArraySelectionTest, WhenThereAreMoreValuesThanFit_ThenTheLargestArrayIsLeftOut) {
  add_blocks("Main.large", 1'000, 8);
  add_blocks("Main.p", 40, 5);
  const auto selection = made();
  EXPECT_TRUE(selection.shows("Main.p[40].m4"));
  EXPECT_FALSE(selection.shows("Main.large[1].m0"));
  ASSERT_EQ(selection.left_out().size(), 1u);
  EXPECT_TRUE(selection.left_out()[0].of_blocks);
  EXPECT_EQ(selection.left_out()[0].values, 8'000u);
}

TEST_F(ArraySelectionTest, WhenANameIsBroken_ThenNothingIsReadBehindIt) {
  for (const char* name : {"a[", "a[1", "[", "a[]]", "a[1][", ""}) add(name);
  const auto selection = made();
  for (const reader::Tag& tag : tags_) EXPECT_TRUE(selection.shows(tag.name)) << tag.name;
}

}  // namespace
}  // namespace stepwright::server

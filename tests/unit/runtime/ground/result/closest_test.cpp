#include "runtime/ground/result/closest.h"

#include <gtest/gtest.h>

#include <vector>

namespace stepwright::result {
namespace {

const std::vector<std::string> kNames = {"load", "unload", "move"};

TEST(Closest, WhenAWordIsWithinTheEdits_ThenItIsFound) {
  ASSERT_NE(closest("lod", kNames, 1), nullptr);
  EXPECT_EQ(*closest("lod", kNames, 1), "load");
  EXPECT_EQ(*closest("loads", kNames, 1), "load");
  EXPECT_EQ(*closest("mode", kNames, 1), "move");
}

TEST(Closest, WhenNeighboursAreSwapped_ThenThatIsOneEdit) {
  ASSERT_NE(closest("laod", kNames, 1), nullptr);
  EXPECT_EQ(*closest("laod", kNames, 1), "load");
}

TEST(Closest, WhenSeveralAreWithinTheEdits_ThenTheFirstOfTheNearestWins) {
  EXPECT_EQ(*closest("unloa", kNames, 6), "unload");
  EXPECT_EQ(*closest("nload", kNames, 6), "load");  // one edit from "unload" as well
}

TEST(Closest, WhenAllNeedMoreEdits_ThenThereIsNone) {
  EXPECT_EQ(closest("lo", kNames, 1), nullptr);
  EXPECT_EQ(closest("Load", kNames, 0), nullptr);
  EXPECT_EQ(closest("load", {}, 9), nullptr);
}

}  // namespace
}  // namespace stepwright::result

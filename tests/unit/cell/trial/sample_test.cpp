#include "cell/trial/sample.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace stepwright::trial {
namespace {

model::GroundAction carry(int box, int zone) {
  return {"carry", {"b" + std::to_string(box), "z" + std::to_string(zone)}};
}

TEST(Sample, WhenEveryObjectWasTriedInEveryPlace_ThenNoMoreIsWanted) {
  Sample sample;
  std::set<std::string> boxes;
  std::set<std::string> zones;
  int tried = 0;
  for (int box = 0; box < 6; ++box) {
    for (int zone = 0; zone < 5; ++zone) {
      const model::GroundAction action = carry(box, zone);
      if (!sample.wants(action)) continue;
      sample.note_tried(action);
      boxes.insert(action.arguments[0]);
      zones.insert(action.arguments[1]);
      ++tried;
    }
  }
  EXPECT_EQ(boxes.size(), 6u);
  EXPECT_EQ(zones.size(), 5u);
  EXPECT_EQ(tried, 5 + 5);  // the first box in every zone, every other one once
}

TEST(Sample, WhenAnObjectIsOutOfReachInOneCombination_ThenItIsTriedInAnother) {
  Sample sample;
  sample.note_unreachable(carry(0, 0));
  EXPECT_TRUE(sample.wants(carry(0, 1)));
  sample.note_tried(carry(0, 1));
  EXPECT_TRUE(sample.wants(carry(1, 0)));
  sample.note_unreachable(carry(1, 0));
  EXPECT_TRUE(sample.wants(carry(1, 1)));
}

TEST(Sample, WhenAnObjectIsNeverWithinReach_ThenItIsSoughtTwice) {
  Sample sample;
  int sought = 0;
  for (int zone = 0; zone < 5; ++zone) sample.note_tried(carry(1, zone));
  for (int zone = 0; zone < 5; ++zone) {
    if (!sample.wants(carry(0, zone))) continue;
    sample.note_unreachable(carry(0, zone));
    ++sought;
  }
  EXPECT_EQ(sought, 2);
}

TEST(Sample, WhenNoneOfTheFirstThreeCanBeReached_ThenNoMoreAreSought) {
  Sample sample;
  int sought = 0;
  for (int box = 0; box < 30; ++box) {
    if (!sample.wants(carry(box, box))) continue;
    sample.note_unreachable(carry(box, box));
    ++sought;
  }
  EXPECT_EQ(sought, 3);
}

TEST(Sample, WhenAnActionHasNoObjects_ThenItIsWanted) {
  EXPECT_TRUE(Sample().wants({"await_reset", {}}));
}

}  // namespace
}  // namespace stepwright::trial

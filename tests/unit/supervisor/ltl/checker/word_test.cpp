#include <gtest/gtest.h>

#include <random>

#include "supervisor/ltl/checker/plan_checker.h"
#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

TEST(ReadWay, WhenAStripIsThinnerThanAStep_ThenItIsRead) {
  std::mt19937 dice(2);
  std::uniform_real_distribution<double> place(0.0, 9.0);
  for (int round = 0; round < 10'000; ++round) {
    const double x = place(dice), y = place(dice);
    const std::vector<Area> strips = {{"strip", {{x, -1}, {x + 1e-3, -1}, {x + 1e-3, 20}, {x, 20}}, {}}};
    std::vector<Label> word;
    read_way(strips, {x - 0.5, y}, {x + 0.7, y + 0.3}, word);
    ASSERT_EQ(word, (std::vector<Label>{0, 1, 0})) << x << " " << y;
  }
}

TEST(ReadWay, WhenPlacesOverlap_ThenEachChangeIsALetter) {
  const std::vector<Area> places = {testing::Rectangle{2, 0, 6, 4}.area("a"),
                                    testing::Rectangle{4, 0, 8, 4}.area("b")};
  std::vector<Label> word;
  read_way(places, {0, 2}, {10, 2}, word);
  EXPECT_EQ(word, (std::vector<Label>{0, 1, 3, 2, 0}));
  read_way(places, {10, 2}, {7, 2}, word);
  EXPECT_EQ(word.back(), Label{2});
  EXPECT_EQ(word.size(), 6u);
}

TEST(ReadWay, WhenAWayHasNoLength_ThenItHasTheLabelOfItsPoint) {
  const std::vector<Area> places = {testing::Rectangle{2, 0, 6, 4}.area("a")};
  std::vector<Label> word;
  read_way(places, {3, 2}, {3, 2}, word);
  EXPECT_EQ(word, std::vector<Label>{1});
}

}  // namespace
}  // namespace stepwright::ltl

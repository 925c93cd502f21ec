#include "supervisor/ltl/drawing/automaton_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace stepwright::ltl {
namespace {

TEST(AutomatonLayout, WhenWaysAreOfDifferentLength_ThenTheLongestCounts) {
  // 0 leads to 2 at once and through 1; 3 is decided.
  const auto places = lay_out({.after = {{0, 1, 2}, {1, 2}, {3}, {}}, .decided = {0, 0, 0, 1}});
  EXPECT_EQ(places[0].column, 0u);
  EXPECT_EQ(places[1].column, 1u);
  EXPECT_EQ(places[2].column, 2u);
  EXPECT_EQ(places[3].column, 3u);
}

TEST(AutomatonLayout, WhenArrowsLeadBack_ThenTheyCountNothing) {
  const auto places = lay_out({.after = {{1}, {2}, {0, 1}}, .decided = {0, 0, 0}});
  EXPECT_EQ(places[2].column, 2u);
  EXPECT_EQ(places[0].column, 0u);
}

TEST(AutomatonLayout, WhenSomeHaveTheFirstRow_ThenTheOthersStandBelow) {
  const auto places =
      lay_out({.after = {{1, 2}, {3}, {3}, {}}, .decided = {0, 0, 0, 1}, .first_row = {0, 2, 3}});
  EXPECT_EQ(places[2].row, 0u);
  EXPECT_EQ(places[1].row, 1u);
  EXPECT_EQ(places[3].row, 0u);
}

TEST(AutomatonLayout, WhenSeveralAreDecided_ThenTheyStandInTheirOrder) {
  const auto places = lay_out({.after = {{1, 2}, {}, {}}, .decided = {0, 2, 1}});
  EXPECT_EQ(places[2].row, 0u);
  EXPECT_EQ(places[1].row, 1u);
}

TEST(AutomatonLayout, WhenAStateIsNotReached_ThenItSaysSo) {
  const auto places = lay_out({.after = {{1}, {}, {1}}, .decided = {0, 1, 0}});
  EXPECT_TRUE(places[1].reached);
  EXPECT_FALSE(places[2].reached);
}

TEST(AutomatonLayout, WhenGraphsAreOfAnyKind_ThenNoTwoStatesStandInOnePlace) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    const std::size_t size = 1 + random() % 20;
    AutomatonGraph graph{.after = std::vector<std::vector<std::uint32_t>>(size),
                         .decided = std::vector<std::uint8_t>(size)};
    for (std::size_t k = 0; k < size; ++k) {
      graph.decided[k] = static_cast<std::uint8_t>(random() % 5 == 0 ? 1 + random() % 2 : 0);
      for (std::size_t n = random() % 4; n > 0 && graph.decided[k] == 0; --n)
        graph.after[k].push_back(static_cast<std::uint32_t>(random() % size));
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> taken;
    std::size_t reached = 0;
    for (const StatePlace& at : lay_out(graph)) {
      if (!at.reached) continue;
      ++reached;
      taken.insert({at.column, at.row});
    }
    EXPECT_EQ(taken.size(), reached) << round;
  }
}

}  // namespace
}  // namespace stepwright::ltl

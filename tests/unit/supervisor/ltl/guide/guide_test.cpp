#include "supervisor/ltl/guide/guide.h"

#include <gtest/gtest.h>

#include <map>
#include <queue>
#include <string>

#include "supervisor/ltl/guide/task.h"
#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

std::vector<std::string> names_of(const Floor& floor) {
  std::vector<std::string> names;
  for (const Area& each : floor.propositions) names.push_back(each.name);
  return names;
}

// From one state of the product on, forwards, each letter read when it differs from the one before.
double forwards_m(const RegionMap& map, const Automaton& automaton, const Guide& guide, Stage from) {
  using Node = std::pair<std::uint32_t, std::uint32_t>;
  std::map<Node, double> known;
  std::priority_queue<std::pair<double, Node>, std::vector<std::pair<double, Node>>, std::greater<>> open;
  open.emplace(0.0, Node{from.region, from.state});
  while (!open.empty()) {
    const auto [way_m, node] = open.top();
    open.pop();
    if (automaton.accepting(node.second)) return way_m;
    if (!known.try_emplace(node, way_m).second) continue;
    const Region& region = map.region(node.first);
    for (std::size_t k = 0; k < 3; ++k) {
      if (region.across[k] == kNoRegion) continue;
      const Label label = map.region(region.across[k]).label;
      const std::uint32_t state = label == region.label ? node.second : automaton.next(node.second, label);
      if (!automaton.rejecting(state))
        open.emplace(way_m + guide.side_m(node.first, k), Node{region.across[k], state});
    }
  }
  return Guide::kNever;
}

std::vector<std::string> formulas_of(const std::vector<std::string>& names) {
  std::vector<std::string> formulas = {"true"};
  if (names.empty()) return formulas;
  formulas.push_back("visit " + names[0]);
  std::string all;
  for (const std::string& each : names) all += (all.empty() ? "visit " : ", visit ") + each;
  formulas.push_back(all);
  if (names.size() < 3) return formulas;
  formulas.push_back("visit " + names[2] + " then visit " + names[0]);
  formulas.push_back("visit " + names[1] + ", " + names[0] + " before " + names[1]);
  formulas.push_back("!" + names[0] + " U (" + names[2] + " & !" + names[1] + ")");
  return formulas;
}

TEST(Guide, WhenFloorsAndTasksAreAnything_ThenWhatIsLeftToGoIsWhatASearchForwardsFinds) {
  int ways = 0, none = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const Floor floor = testing::random_squares(seed).floor();
    const auto map = make_regions(floor);
    if (!map) continue;  // nothing is free
    for (const std::string& text : formulas_of(names_of(floor))) {
      const auto task = read_task(text, names_of(floor));
      ASSERT_TRUE(task) << text;
      const Guide guide(*map, task->automaton);
      for (std::uint32_t region = 0; region < map->regions().size(); region += 7) {
        const Stage from{region, guide.start(region)};
        const double expected = forwards_m(*map, task->automaton, guide, from);
        const double told = guide.to_go_m(from.region, from.state);
        if (expected == Guide::kNever) {
          EXPECT_EQ(told, Guide::kNever) << seed << " " << text;
          EXPECT_TRUE(guide.way(from.region, from.state).empty());
          ++none;
        } else {
          EXPECT_NEAR(told, expected, 1e-9 * (1.0 + expected)) << seed << " " << text;
          ++ways;
        }
      }
    }
  }
  EXPECT_GT(ways, 500);
  EXPECT_GT(none, 10);
}

TEST(Guide, WhenThereIsAWay_ThenItsStagesAreNeighboursAndItsLengthIsWhatIsLeftToGo) {
  for (std::uint32_t seed = 100; seed < 130; ++seed) {
    const Floor floor = testing::random_squares(seed).floor();
    const auto map = make_regions(floor);
    if (!map) continue;
    for (const std::string& text : formulas_of(names_of(floor))) {
      const auto task = read_task(text, names_of(floor));
      const Guide guide(*map, task->automaton);
      const std::vector<Stage> way = guide.way(0, guide.start(0));
      if (way.empty()) continue;
      EXPECT_EQ(way.front(), (Stage{0, guide.start(0)}));
      EXPECT_TRUE(task->automaton.accepting(way.back().state));
      double length_m = 0.0;
      for (std::size_t i = 0; i + 1 < way.size(); ++i) {
        const auto& across = map->region(way[i].region).across;
        const auto side = std::find(across.begin(), across.end(), way[i + 1].region);
        ASSERT_NE(side, across.end());
        length_m += guide.side_m(way[i].region, static_cast<std::size_t>(side - across.begin()));
        EXPECT_EQ(guide.after(way[i].state, way[i].region, way[i + 1].region), way[i + 1].state);
        EXPECT_FALSE(task->automaton.accepting(way[i].state)) << "it ends at the first";
      }
      EXPECT_NEAR(length_m, guide.to_go_m(0, guide.start(0)), 1e-9 * (1.0 + length_m));
    }
  }
}

}  // namespace
}  // namespace stepwright::ltl

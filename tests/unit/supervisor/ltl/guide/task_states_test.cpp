#include "supervisor/ltl/guide/task_states.h"

#include <gtest/gtest.h>

#include "supervisor/ltl/guide/task.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::ltl {
namespace {

const std::vector<std::string> kNames = {"p1", "p2", "p3", "p4", "p5", "p6", "p7", "p8"};

TEST(TaskStates, WhenPlacesAreVisited_ThenFewerAreLeft) {
  const auto left_after = [](const std::string& text, const std::vector<Letter>& word) {
    const auto formula = parse_formula(text, {}, kNames);
    const TaskStates steps(*formula);
    std::uint32_t state = steps.start();
    for (const Letter letter : word) state = steps.next(state, letter);
    return steps.left(state);
  };
  EXPECT_EQ(left_after("F p1 & F p2 & F p3", {}), 3u);
  EXPECT_EQ(left_after("F p1 & F p2 & F p3", {0, 2}), 2u);
  EXPECT_EQ(left_after("F p1 & F p2 & F p3", {5, 2}), 0u);
  EXPECT_EQ(left_after("F p1 & F p2 | F p3", {}), 1u);
  EXPECT_EQ(left_after("F(p1 & F(p2 & F p3))", {}), 3u);
  EXPECT_EQ(left_after("F(p1 & F(p2 & F p3))", {1, 0}), 2u);
  EXPECT_EQ(left_after("!p2 U p1", {}), 1u);
  EXPECT_GT(left_after("!p2 U p1", {2}), 1000u) << "it cannot be done any more";
  const std::string in_order = test::five_visits(8, true);
  EXPECT_EQ(left_after(in_order, {}), 5u);
  EXPECT_EQ(left_after(in_order, {1, 0, 2, 0, 4, 0, 1}), 1u);
  EXPECT_EQ(left_after(in_order, {1, 0, 2, 0, 4, 0, 1, 0, 2}), 0u);
}

TEST(TaskStates, WhenThereIsAnAutomaton_ThenItsDistanceIsLeft) {
  const auto task = read_task(test::coverage(4), {"p1", "p2", "p3", "p4"});
  const TaskStates states(task->automaton);
  EXPECT_EQ(states.left(states.start()), task->automaton.distance[task->automaton.initial]);
  EXPECT_EQ(states.left(states.next(states.start(), 15)), 0u);
}

}  // namespace
}  // namespace stepwright::ltl

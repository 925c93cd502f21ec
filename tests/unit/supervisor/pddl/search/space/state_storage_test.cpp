#include <gtest/gtest.h>

#include <map>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/search/space/state_table.h"
#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/random_walk.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

GroundTask arranged(const Task& task) {
  GroundTask ground = ground_task(task.definition(), [] { return false; });
  arrange_by_groups(ground);
  return ground;
}

// Every state comes back as it went in, and two states share a number only if they are equal.
void expect_faithful(const Task& task, std::uint32_t seed) {
  const GroundTask ground = arranged(task);
  if (ground.unreachable_goal) return;
  const StateSpace space(ground);
  StateTable table(space);
  std::map<std::vector<Word>, std::uint32_t> known;
  std::vector<Word> loaded(space.words());
  testing::random_walk(space, seed, 400, [&](const std::vector<Word>& state) {
    const auto [node, added] = table.insert(state.data());
    const auto [place, fresh] = known.emplace(state, node);
    EXPECT_EQ(added, fresh);
    EXPECT_EQ(place->second, node);
    table.load(node, loaded.data());
    EXPECT_EQ(loaded, state);
  });
  EXPECT_EQ(table.size(), known.size());
}

TEST(StateTable, WhenStatesOfSampleTasksAreStored_ThenTheyComeBackUnchanged) {
  expect_faithful(testing::bench_task(), 1);
  expect_faithful(testing::bench_task("_load"), 2);
  expect_faithful(testing::logistics_task(70), 3);
  expect_faithful(testing::counter_task("(= (n) 50)"), 4);
  expect_faithful(testing::lamps_task("(forall (?l - lamp) (on ?l))"), 5);
}

TEST(StateTable, WhenStatesOfRandomTasksAreStored_ThenTheyComeBackUnchanged) {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const testing::RandomTask random = testing::random_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    expect_faithful(random.task, seed);
  }
}

TEST(StateTable, WhenNumbersAreNoIntegersOrUndefined_ThenTheyComeBackUnchanged) {
  const Task task = testing::make_task(
      R"((define (domain d) (:requirements :numeric-fluents) (:functions (x) (y) (z))
    (:action a :parameters () :precondition (<= (x) 5) :effect (increase (x) 0.1))
    (:action b :parameters () :precondition (>= (x) 1) :effect (and (scale-down (x) 3) (assign (y) (x))))
    (:action c :parameters () :precondition (<= (z) 1000000) :effect (increase (z) 7))))",
      R"((define (problem p) (:domain d) (:init (= (x) 0) (= (z) -4))
    (:goal (and (>= (x) 0.25) (>= (z) 10) (>= (y) 0)))))");
  expect_faithful(task, 7);
}

TEST(StateTable, WhenTheBenchIsStored_ThenAStateTakesTwoWordsAtMost) {
  const GroundTask ground = arranged(testing::bench_task());
  const StateSpace space(ground);
  EXPECT_LE(StateCodec(ground, space.domains()).words(), 2u);
}

}  // namespace
}  // namespace stepwright::pddl

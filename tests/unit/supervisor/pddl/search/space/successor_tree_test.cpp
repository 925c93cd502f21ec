#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "supervisor/pddl/grounding/grounder.h"
#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/random_walk.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

// The tree finds what asking every operator finds.
void expect_complete(const Task& task, std::uint32_t seed) {
  GroundTask ground = ground_task(task.definition(), [] { return false; });
  arrange_by_groups(ground);
  const StateSpace space(ground);
  std::vector<int> found;
  testing::random_walk(space, seed, 200, [&](const std::vector<Word>& state) {
    std::vector<int> expected;
    for (std::size_t op = 0; op < ground.operators.size(); ++op) {
      if (space.holds(ground.operators[op].precondition, state.data()))
        expected.push_back(static_cast<int>(op));
    }
    space.applicable(state.data(), found);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  });
}

TEST(SuccessorTree, WhenOnSampleTasks_ThenItFindsWhatAskingEveryOperatorFinds) {
  expect_complete(testing::bench_task(), 1);
  expect_complete(testing::logistics_task(70), 2);
  expect_complete(testing::lamps_task("(forall (?l - lamp) (on ?l))"), 3);
}

// One operator for each lamp, one that needs all of them: neither may go as deep as there are lamps.
TEST(SuccessorTree, WhenThereAreVeryManyVariables_ThenTheStackDoesNotMind) {
  constexpr int kLamps = 60'000;
  std::string lamps;
  for (int i = 0; i < kLamps; ++i) lamps += " l" + std::to_string(i);
  const Task task = testing::make_task(
      R"((define (domain d) (:requirements :adl) (:predicates (on ?l) (done))
        (:action light :parameters (?l) :precondition (not (on ?l)) :effect (on ?l))
        (:action end :precondition (forall (?l) (on ?l)) :effect (done))))",
      "(define (problem p) (:domain d) (:objects" + lamps + ") (:init) (:goal (done)))");
  GroundTask ground = ground_task(task.definition(), [] { return false; });
  ASSERT_EQ(ground.operators.size(), kLamps + 1u);
  arrange_by_groups(ground);
  const StateSpace space(ground);
  std::vector<int> found;
  std::vector<Word> state = space.initial();
  space.applicable(state.data(), found);
  EXPECT_EQ(found.size(), static_cast<std::size_t>(kLamps));
}

TEST(SuccessorTree, WhenOnRandomTasks_ThenItFindsWhatAskingEveryOperatorFinds) {
  for (std::uint32_t seed = 100; seed < 160; ++seed) {
    const testing::RandomTask random = testing::random_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    expect_complete(random.task, seed);
  }
}

}  // namespace
}  // namespace stepwright::pddl

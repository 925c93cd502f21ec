#include "supervisor/pddl/search/engines/lookahead.h"

#include <gtest/gtest.h>

#include <atomic>

#include "supervisor/pddl/grounding/grounder.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

// One operator that adds one to a number, which is to be applied a million times.
class LongWay : public ::testing::Test {
 protected:
  const Task task_ = testing::make_task(
      R"((define (domain d) (:requirements :numeric-fluents) (:functions (n))
    (:action up :parameters () :precondition (>= (n) 0) :effect (increase (n) 1))))",
      "(define (problem p) (:domain d) (:init (= (n) 0)) (:goal (= (n) 1000000)))");
  const GroundTask ground_ = ground_task(task_.definition(), [] { return false; });
  const StateSpace space_{ground_};
  const RelaxedTask relaxed_{space_};
  std::atomic<bool> cancel_{false};
  SearchControl control_{std::chrono::milliseconds(0), 0, &cancel_};
  Lookahead lookahead_{relaxed_, control_};
  std::vector<Word> state_ = space_.initial();
};

TEST_F(LongWay, WhenNothingStopsIt_ThenEveryStepIsTaken) {
  std::size_t steps = 0;
  lookahead_.follow(state_, {{0, 1'000'000, 0}}, [&](int op, double, const std::vector<Word>& next) {
    steps += op == 0 && next != state_ ? 1 : 0;
    return true;
  });
  EXPECT_EQ(steps, 1'000'000u);
  EXPECT_TRUE(space_.goal(state_.data()));
}

TEST_F(LongWay, WhenTheControlSaysStop_ThenItEndsOnItsWay) {
  std::size_t steps = 0;
  lookahead_.follow(state_, {{0, 1'000'000, 0}}, [&](int, double, const std::vector<Word>&) {
    if (++steps == 1000) cancel_ = true;
    return true;
  });
  EXPECT_GE(steps, 1000u);
  EXPECT_LE(steps, 1100u);
  EXPECT_FALSE(space_.goal(state_.data()));
}

TEST_F(LongWay, WhenAStepIsRefused_ThenTheStateStays) {
  lookahead_.follow(state_, {{0, 1, 0}}, [](int, double, const std::vector<Word>&) { return false; });
  EXPECT_EQ(state_, space_.initial());
}

}  // namespace
}  // namespace stepwright::pddl

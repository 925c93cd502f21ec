// The bound by linear programming where its value is known, and how it stops.

#include "supervisor/pddl/search/lp/lp_bound.h"

#include <gtest/gtest.h>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/planner/solve.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

// A task with all that bounds are made of.
struct Setting {
  explicit Setting(const Task& task)
      : ground(ground_task(task.definition(), [] { return false; })),
        space(arranged(ground)),
        relaxed(space) {}

  static const GroundTask& arranged(GroundTask& task) {
    arrange_by_groups(task);
    return task;
  }

  GroundTask ground;
  StateSpace space;
  RelaxedTask relaxed;
};

double root_bound(const Task& task, int rounds) {
  const Setting setting(task);
  LpBound bound(setting.relaxed, [] { return false; });
  return bound.cost(setting.space.initial().data(), {.rounds = rounds});
}

// Counters that shall be at least one apart, in ascending order; they start the other way around.
Task counters(int count) {
  std::string functions, actions, init, goal;
  for (int i = 0; i < count; ++i) {
    const std::string here = "(c" + std::to_string(i) + ")";
    functions += here;
    init += "(= " + here + " " + std::to_string(2 * (count - i)) + ")";
    actions += "(:action up" + std::to_string(i) + " :parameters () :precondition (< " + here +
               " 40) :effect (increase " + here + " 1))";
    actions += "(:action down" + std::to_string(i) + " :parameters () :precondition (> " + here +
               " 0) :effect (decrease " + here + " 1))";
    if (i > 0) goal += "(< (c" + std::to_string(i - 1) + ") " + here + ")";
  }
  return testing::make_task(
      "(define (domain d) (:requirements :numeric-fluents) (:functions " + functions + ")" + actions + ")",
      "(define (problem p) (:domain d) (:init " + init + ") (:goal (and " + goal + ")))");
}

TEST(LpBound, WhenGoalsShareNumbers_ThenTheRootIsExact) {
  // 12 10 8 6 4 2 becomes 4 5 6 7 8 9 or another such row about the middle.
  EXPECT_EQ(root_bound(counters(6), 0), 27.0);
  Options options;
  options.optimal = true;
  const model::Outcome outcome = solve(counters(6), options);
  ASSERT_TRUE(outcome.plan.has_value());
  EXPECT_TRUE(outcome.plan->proved_optimal);
  EXPECT_EQ(outcome.plan->cost, 27.0);
  EXPECT_LT(outcome.expanded, 2000u);
}

TEST(LpBound, WhenAMoverMustRepeat_ThenEveryApplicationCounts) {
  // Four times +3 at cost 2.
  EXPECT_EQ(root_bound(testing::counter_task("(>= (n) 12)"), 0), 8.0);
  EXPECT_EQ(root_bound(testing::counter_task("(= (n) 12)"), 2), 8.0);
}

TEST(LandmarkCut, WhenAMoverMustRepeat_ThenEveryApplicationCounts) {
  const Setting setting(testing::counter_task("(>= (n) 12)"));
  LandmarkCut cut(setting.relaxed);
  EXPECT_NEAR(cut(setting.space.initial().data()), 8.0, 1e-6);
}

TEST(LpBound, WhenFuelCannotLast_ThenThereIsNoPlan) {
  const Setting setting(testing::make_task(
      R"((define (domain d) (:requirements :strips :numeric-fluents) (:functions (fuel) (way))
    (:action go :parameters () :precondition (>= (fuel) 2) :effect (and (decrease (fuel) 2) (increase (way) 1)))
    (:action waste :parameters () :precondition (>= (fuel) 1) :effect (decrease (fuel) 1))))",
      "(define (problem p) (:domain d) (:init (= (fuel) 6) (= (way) 0)) (:goal (>= (way) 3)))"));
  LpBound bound(setting.relaxed, [] { return false; });
  std::vector<Word> state = setting.space.initial(), next(state.size());
  EXPECT_EQ(bound.cost(state.data(), {}), 3.0);
  double cost = 0.0;
  for (const GroundOperator& op : setting.ground.operators) {
    if (op.effects.front().numeric.size() == 1) setting.space.apply(op, state.data(), next.data(), cost);
  }
  EXPECT_EQ(bound.cost(next.data(), {}), kInfinity);
  EXPECT_EQ(bound.steps(next.data(), 100.0, {}), kInfinity);
}

TEST(LpBound, WhenTheCostIsLimited_ThenTheStepsThatItAllowsAreCounted) {
  // +1 costs 1, +3 costs 2: twelve take four steps at cost 8; with less there is no plan.
  const Setting setting(testing::counter_task("(>= (n) 12)"));
  LpBound bound(setting.relaxed, [] { return false; });
  const std::vector<Word> state = setting.space.initial();
  EXPECT_EQ(bound.steps(state.data(), 8.0, {}), 4.0);
  EXPECT_EQ(bound.steps(state.data(), 100.0, {}), 4.0);
  EXPECT_EQ(bound.steps(state.data(), 7.0, {}), kInfinity);
}

TEST(LpBound, WhenMoreRoundsAreAllowed_ThenTheBoundDoesNotFall) {
  const Setting setting(testing::logistics_task(6));
  LpBound bound(setting.relaxed, [] { return false; });
  const std::vector<Word> state = setting.space.initial();
  double last = 0.0;
  for (const int rounds : {0, 1, 2, 8}) {
    const double now = bound.cost(state.data(), {.rounds = rounds});
    EXPECT_GE(now, last);
    last = now;
  }
  EXPECT_GE(last, 9.0);  // of ten: five drives, two loads, two unloads, and the way back is not seen
}

// Whenever it is told to stop, it asks only a few times more.
TEST(LpBound, WhenToldToStop_ThenItEndsWithinAFewQuestions) {
  const Setting setting(counters(40));
  const std::vector<Word> state = setting.space.initial();
  int all = 0;
  {
    LpBound whole(setting.relaxed, [&] { return ++all < 0; });
    whole.cost(state.data(), {.rounds = 8});
  }
  ASSERT_GT(all, 20);
  const double unstopped = root_bound(counters(40), 8);
  for (int allowed = 0; allowed < all; allowed += 7) {
    int asked = 0;
    LpBound bound(setting.relaxed, [&] { return ++asked > allowed; });
    const double stopped = bound.cost(state.data(), {.rounds = 8});
    EXPECT_LE(asked, allowed + 3);
    EXPECT_LE(stopped, unstopped);
  }
}

TEST(LandmarkCut, WhenToldToStop_ThenItEndsAfterThatSet) {
  const Setting setting(counters(20));
  const std::vector<Word> state = setting.space.initial();
  int all = 0;
  LandmarkCut whole(setting.relaxed, [&] { return ++all < 0; });
  const double bound = whole(state.data());
  ASSERT_GT(all, 5);
  double last = 0.0;
  for (int allowed = 0; allowed < all; ++allowed) {
    int asked = 0;
    LandmarkCut cut(setting.relaxed, [&] { return ++asked > allowed; });
    const double stopped = cut(state.data());
    EXPECT_EQ(asked, allowed + 1);
    EXPECT_GE(stopped, last);
    EXPECT_LE(stopped, bound);
    last = stopped;
  }
}

}  // namespace
}  // namespace stepwright::pddl

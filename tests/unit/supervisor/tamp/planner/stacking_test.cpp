#include <gtest/gtest.h>

#include <map>

#include "supervisor/htn/plan/validate.h"
#include "supervisor/pddl/plan/validate.h"
#include "supervisor/tamp/judge/plan_judge.h"
#include "supervisor/tamp/planner/skeleton_planner.h"
#include "supervisor/tamp/predicates/grounding.h"
#include "supervisor/tamp/predicates/workspace.h"
#include "tests/support/tamp_cells/paper_cells.h"

namespace stepwright::tamp::planner {
namespace {

TampOptions options_of(std::uint64_t seed) {
  TampOptions options;
  options.seed = seed;
  options.most_failed = 200'000;
  return options;
}

TampOutcome stacked(const test::PaperProblem& problem, std::uint64_t seed) {
  const IntervalModel model(problem.cell);
  return plan(problem.cell, problem.task, &model, options_of(seed));
}

TampOutcome by_skeletons(const test::SkeletonProblem& problem, const TampOptions& options) {
  const IntervalModel model(problem.cell);
  return plan(problem.cell, problem.task, model, options);
}

// Of each thing that is placed: on what it was last.
std::map<int, int> stands_on(const scene::TampPlan& plan) {
  std::map<int, int> on;
  for (const scene::PlannedAction& each : plan.actions)
    if (each.what.kind == scene::ActionKind::Place) on[each.what.thing] = each.what.on;
  return on;
}

TEST(Stacking, WhenThingsBecomeATower_ThenTheJudgeAcceptsItAndRefusesSpoiltOnes) {
  auto problem = test::paper_problem("tower");
  ASSERT_TRUE(problem);
  test::move_things(problem->cell, 1);
  const TampOutcome outcome = stacked(*problem, 1);
  ASSERT_TRUE(outcome.plan) << outcome.reason;
  const auto& names = predicates::geometric_predicates();
  EXPECT_TRUE(
      htn::validate(problem->domain, problem->problem, *outcome.tasks, {names.begin(), names.end()}).valid);
  const judge::Judgement judged = judge::judge(problem->cell, *outcome.plan);
  EXPECT_TRUE(judged.sound) << judged.reason;
  ASSERT_EQ(outcome.plan->actions.size(), 6u);
  EXPECT_EQ(stands_on(*outcome.plan), (std::map<int, int>{{0, -1}, {1, 0}, {2, 1}}));
  EXPECT_EQ(outcome.plan->actions[5].pose.x_m, outcome.plan->actions[1].pose.x_m);
  EXPECT_NEAR(outcome.plan->actions[5].pose.z_m, 0.71 + 2 * 0.06, 1e-9);

  const auto reason_of = [&](const auto& spoil) {
    test::PaperProblem spoilt = *problem;
    scene::TampPlan plan = *outcome.plan;
    spoil(spoilt.cell, plan);
    return judge::judge(spoilt.cell, plan).reason;
  };
  EXPECT_NE(reason_of([](scene::RobotCell& cell, scene::TampPlan&) {
              cell.things[0].carries = false;
            }).find("carries nothing"),
            std::string::npos);
  EXPECT_NE(reason_of([](scene::RobotCell&, scene::TampPlan& plan) { plan.actions[5].what.on = 0; }), "");
  // A lower one would leave a gap above it.
  EXPECT_NE(
      reason_of([](scene::RobotCell& cell, scene::TampPlan&) { cell.things[0].form.height_m -= 0.001; }), "");
  // Somebody stands on what is picked.
  EXPECT_NE(reason_of([](scene::RobotCell& cell, scene::TampPlan&) {
              cell.things[2].start = top_of(cell, 0, cell.things[0].start, 0.0);
            }).find("can3"),
            std::string::npos);
}

TEST(Stacking, WhenAThingCarriesAnother_ThenItIsNotPickedAndWhatIsAboveItIsBlamed) {
  auto problem = test::paper_problem("tower");
  ASSERT_TRUE(problem);
  const scene::RobotCell& cell = problem->cell;
  predicates::Workspace workspace(cell, 1);
  scene::GeometricState state = initial_state(cell);
  const int right = cell.arm("right");
  state.things[1].pose = top_of(cell, 0, state.things[0].pose, 0.0);
  const scene::ActionSpec pick_lower{scene::ActionKind::Pick, right, 0, -1};
  const auto lower = workspace.ways(state, pick_lower, {0.0, {}});
  ASSERT_FALSE(lower);
  EXPECT_EQ(lower.error().things, 2u);
  // There is no second place on it, none on what is held, and none where the carrier is narrower.
  state.things[2].holder = right;
  state.arms[static_cast<std::size_t>(right)].holds = 2;
  scene::ActionSpec put{scene::ActionKind::Place, right, 2, -1, 0};
  const auto second = workspace.ways(state, put, {0.0, top_of(cell, 0, state.things[0].pose, 0.0)});
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, predicates::FailureKind::NoRoom);
  EXPECT_EQ(second.error().things, 2u);
  put.on = 2;
  EXPECT_EQ(workspace.ways(state, put, {0.0, {}}).error().kind, predicates::FailureKind::Impossible);
  EXPECT_FALSE(fits_on(cell.things[0].form, cell.things[2].form));
}

TEST(Stacking, WhenTheLargestIsToStandOnTheSmallest_ThenThatIsProvedAndSaid) {
  auto problem = test::paper_problem("tower");
  ASSERT_TRUE(problem);
  std::swap(problem->cell.things[0].form.radius_m, problem->cell.things[2].form.radius_m);
  const TampOutcome outcome = stacked(*problem, 1);
  EXPECT_EQ(outcome.kind, model::OutcomeKind::Infeasible);
  EXPECT_EQ(outcome.reason, "can2 is wider than can1");
  EXPECT_EQ(outcome.figures.configurations, 0u);
}

TEST(Skeletons, WhenTheGoalIsPddl_ThenThePlansAreSound) {
  for (const std::string name : {"tower_pddl", "p1_pddl"}) {
    const auto problem = test::skeleton_problem(name);
    ASSERT_TRUE(problem);
    const TampOutcome outcome = by_skeletons(*problem, options_of(1));
    ASSERT_TRUE(outcome.plan) << name << ": " << outcome.reason;
    pddl::PlanText text;
    text.actions = outcome.skeleton->actions;
    text.lines.assign(text.actions.size(), 0);
    EXPECT_TRUE(pddl::validate(problem->task.task, text).valid) << name;
    const judge::Judgement judged = judge::judge(problem->cell, *outcome.plan);
    EXPECT_TRUE(judged.sound) << name << ": " << judged.reason;
    if (name == "tower_pddl") {
      EXPECT_EQ(stands_on(*outcome.plan), (std::map<int, int>{{0, -1}, {1, 0}, {2, 1}}));
    } else {
      // One arm alone does not do; that was refuted, and both have moved the cup.
      EXPECT_GT(outcome.figures.refuted, 0u);
      EXPECT_GE(outcome.plan->actions.size(), 4u);
    }
  }
}

TEST(Skeletons, WhenNoArmReachesARegion_ThenThatIsProved) {
  auto problem = test::skeleton_problem("p1_pddl");
  ASSERT_TRUE(problem);
  scene::RobotCell& cell = problem->cell;
  cell.surfaces[static_cast<std::size_t>(cell.surface("red-region"))].middle.y_m = 1.3;
  // With the other region gone as well there is nothing to try for ever.
  cell.surfaces[static_cast<std::size_t>(cell.surface("box-top"))].middle.y_m = 1.3;
  const TampOutcome outcome = by_skeletons(*problem, options_of(1));
  EXPECT_EQ(outcome.kind, model::OutcomeKind::Infeasible) << outcome.reason;
  EXPECT_EQ(outcome.figures.configurations, 0u);
  EXPECT_FALSE(outcome.reason.empty());
}

// P1 as a goal takes three skeletons.
TEST(Skeletons, WhenCountedWorkIsUsedUp_ThenItEndsWithoutAPlanAndNotByTheClock) {
  const auto problem = test::skeleton_problem("p1_pddl");
  ASSERT_TRUE(problem);
  TampOptions few = options_of(1);
  few.most_skeletons = 1;
  const TampOutcome one = by_skeletons(*problem, few), again = by_skeletons(*problem, few);
  EXPECT_EQ(one.kind, model::OutcomeKind::Exhausted);
  EXPECT_FALSE(one.plan);
  EXPECT_FALSE(one.by_clock) << one.reason;
  EXPECT_EQ(one.figures.decompositions, 1u);
  EXPECT_EQ(one.figures.states, again.figures.states);
  EXPECT_EQ(one.figures.configurations, again.figures.configurations);
  EXPECT_EQ(one.reason, again.reason);
  TampOptions states = options_of(1);
  states.most_states = 1;
  const TampOutcome narrow = by_skeletons(*problem, states);
  EXPECT_FALSE(narrow.plan);
  EXPECT_FALSE(narrow.by_clock) << narrow.reason;
  EXPECT_EQ(narrow.figures.states, 1u);
}

TEST(Skeletons, WhenTheDeadlineEndsASearch_ThenTheOutcomeSaysSo) {
  const auto problem = test::skeleton_problem("p1_pddl");
  ASSERT_TRUE(problem);
  TampOptions late = options_of(1);
  late.until = std::chrono::steady_clock::now();
  const TampOutcome outcome = by_skeletons(*problem, late);
  EXPECT_FALSE(outcome.plan);
  EXPECT_TRUE(outcome.by_clock);
  EXPECT_NE(outcome.reason.find("the time limit ended it"), std::string::npos) << outcome.reason;
}

}  // namespace
}  // namespace stepwright::tamp::planner

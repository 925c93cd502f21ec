#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "supervisor/htn/plan/validate.h"
#include "supervisor/tamp/judge/plan_judge.h"
#include "supervisor/tamp/planner/tamp_planner.h"
#include "supervisor/tamp/predicates/grounding.h"
#include "tests/support/tamp_cells/paper_cells.h"

namespace stepwright::tamp::planner {
namespace {

TampOutcome planned(const test::PaperProblem& problem, Method method, std::uint64_t seed) {
  std::optional<IntervalModel> model;
  if (method == Method::Ours) model.emplace(problem.cell);
  TampOptions options;
  options.method = method;
  options.seed = seed;
  options.most_failed = 100'000;
  return plan(problem.cell, problem.task, model ? &*model : nullptr, options);
}

void expect_sound(const test::PaperProblem& problem, const TampOutcome& outcome, const std::string& name) {
  ASSERT_TRUE(outcome.plan) << name << ": " << outcome.reason;
  const auto& names = predicates::geometric_predicates();
  EXPECT_TRUE(
      htn::validate(problem.domain, problem.problem, *outcome.tasks, {names.begin(), names.end()}).valid);
  const judge::Judgement judged = judge::judge(problem.cell, *outcome.plan);
  EXPECT_TRUE(judged.sound) << name << ": " << judged.reason;
  EXPECT_GT(judged.motions, 3 * outcome.plan->actions.size());
}

TEST(PaperProblems, WhenOursPlans_ThenTheJudgeAcceptsAllOfThem) {
  const std::map<std::string, std::size_t> actions = {{"p1", 5}, {"p2", 4}, {"p3", 6},
                                                      {"p4", 8}, {"p5", 4}, {"p6", 6}};
  for (const auto& [name, count] : actions) {
    auto problem = test::paper_problem(name);
    ASSERT_TRUE(problem);
    test::move_things(problem->cell, 1);
    const TampOutcome outcome = planned(*problem, Method::Ours, 1);
    expect_sound(*problem, outcome, name);
    if (outcome.plan) {
      EXPECT_EQ(outcome.plan->actions.size(), count) << name;
    }
    EXPECT_LT(outcome.figures.failed, 1000u) << name;
  }
}

TEST(PaperProblems, WhenGeometricBacktrackingPlans_ThenTheJudgeAcceptsItToo) {
  for (const std::string name : {"p2", "p5"}) {
    auto problem = test::paper_problem(name);
    ASSERT_TRUE(problem);
    problem->cell.manner.grasps = 2;
    problem->cell.manner.places = 30;
    expect_sound(*problem, planned(*problem, Method::PaperLiteral, 1), name);
  }
}

TEST(PaperProblems, WhenTheSeedIsTheSame_ThenThePlanIsTheSame) {
  auto problem = test::paper_problem("p1");
  ASSERT_TRUE(problem);
  const TampOutcome one = planned(*problem, Method::Ours, 5), two = planned(*problem, Method::Ours, 5);
  ASSERT_TRUE(one.plan && two.plan);
  for (std::size_t k = 0; k < one.plan->actions.size(); ++k)
    for (std::size_t m = 0; m < one.plan->actions[k].motions.size(); ++m)
      EXPECT_EQ(one.plan->actions[k].motions[m].path, two.plan->actions[k].motions[m].path);
}

TEST(PaperProblems, WhenTheTrayIsTooSmall_ThenThatIsProvedAndSaid) {
  auto problem = test::paper_problem("p4");
  ASSERT_TRUE(problem);
  scene::Surface& tray = problem->cell.surfaces[static_cast<std::size_t>(problem->cell.surface("tray"))];
  tray.size_x_m = 0.12;
  const TampOutcome outcome = planned(*problem, Method::Ours, 1);
  EXPECT_EQ(outcome.kind, model::OutcomeKind::Infeasible);
  EXPECT_EQ(outcome.reason, "tray takes no more than 2 of can1, can2, can3");
  EXPECT_EQ(outcome.figures.budget_nogoods, 0u);
}

TEST(PaperProblems, WhenFurnitureIsInTheWay_ThenItIsNamed) {
  auto problem = test::paper_problem("p4");
  ASSERT_TRUE(problem);
  const scene::Pose tray =
      problem->cell.surfaces[static_cast<std::size_t>(problem->cell.surface("tray"))].middle;
  const auto with = [&](const char* name, scene::Form form, double above_m) {
    auto changed = *problem;
    scene::Pose pose = tray;
    pose.z_m += above_m;
    changed.cell.furniture.push_back({name, form, pose});
    return planned(changed, Method::Ours, 1).reason;
  };
  // A can of 120 mm has room below it, and does not come there from above.
  EXPECT_THAT(with("lid", {false, 0.0, 0.3, 0.3, 0.02}, 0.14),
              testing::HasSubstr("no room: lid is in the way"));
}

TEST(PaperProblems, WhenSequencesAreGivenUpForNow_ThenTheyAreTriedAgainWithMore) {
  auto problem = test::paper_problem("p1");
  ASSERT_TRUE(problem);
  const IntervalModel model(problem->cell);
  TampOptions options;
  options.first_failed = 1;
  options.most_failed = 100'000;
  const TampOutcome later = plan(problem->cell, problem->task, &model, options);
  expect_sound(*problem, later, "p1");
  EXPECT_GT(later.figures.budget_nogoods, 0u);
  EXPECT_GT(later.figures.rounds, 1u);
  // Nothing is proved of what was given up: a region that no hand comes to is tried until all is used up.
  auto walled = *problem;
  for (const double y_m : {0.4, 0.6})
    walled.cell.furniture.push_back({"wall", {false, 0.0, 0.2, 0.02, 0.5}, {0.45, y_m, 0.7, 0.0}});
  options.most_failed = 3'000;
  const TampOutcome never = plan(walled.cell, walled.task, &model, options);
  EXPECT_EQ(never.kind, model::OutcomeKind::Exhausted);
  EXPECT_GT(never.figures.rounds, 2u);
  EXPECT_EQ(never.figures.proved_nogoods, 0u);
  EXPECT_GE(never.figures.failed, options.most_failed);
}

TEST(PaperProblems, WhenNoArmReachesARegion_ThenThatIsProvedByIntervals) {
  auto problem = test::paper_problem("p1");
  ASSERT_TRUE(problem);
  problem->cell.surfaces[static_cast<std::size_t>(problem->cell.surface("red-region"))].middle.y_m = 1.3;
  const TampOutcome outcome = planned(*problem, Method::Ours, 1);
  EXPECT_EQ(outcome.kind, model::OutcomeKind::Infeasible) << outcome.reason;
  EXPECT_EQ(outcome.figures.configurations, 0u);
  EXPECT_FALSE(outcome.reason.empty());
}

TEST(PlanJudge, WhenAPlanIsSpoilt_ThenItIsRefused) {
  auto problem = test::paper_problem("p2");
  ASSERT_TRUE(problem);
  const TampOutcome outcome = planned(*problem, Method::Ours, 1);
  ASSERT_TRUE(outcome.plan);
  const auto reason_of = [&](const auto& spoil) {
    scene::TampPlan plan = *outcome.plan;
    spoil(plan);
    return judge::judge(problem->cell, plan).reason;
  };
  EXPECT_EQ(reason_of([](scene::TampPlan&) {}), "");
  EXPECT_NE(reason_of([](scene::TampPlan& plan) { plan.actions.erase(plan.actions.begin()); }), "");
  EXPECT_NE(reason_of([](scene::TampPlan& plan) {
              plan.actions[1].motions.erase(plan.actions[1].motions.begin());
            }).find("does not begin"),
            std::string::npos);
  EXPECT_NE(reason_of([](scene::TampPlan& plan) { plan.actions[0].motions.pop_back(); }).find("the hand is"),
            std::string::npos);
  EXPECT_NE(reason_of([](scene::TampPlan& plan) { plan.actions[3].pose.x_m += 0.001; }).find("elsewhere"),
            std::string::npos);
  // Both cans to one place: the second one is driven to where the first one stands.
  auto moved = *problem;
  moved.cell.things[1].start = outcome.plan->actions[1].pose;
  EXPECT_NE(judge::judge(moved.cell, *outcome.plan).reason, "");
  // A box in the way of a path.
  auto blocked = *problem;
  blocked.cell.furniture.push_back({"block", {false, 0.0, 0.1, 0.6, 0.5}, {0.45, -0.36, 0.85, 0.0}});
  EXPECT_NE(judge::judge(blocked.cell, *outcome.plan).reason.find("meets"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::tamp::planner

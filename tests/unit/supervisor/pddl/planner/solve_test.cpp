#include "supervisor/pddl/planner/solve.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>

#include "supervisor/pddl/plan/validate.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

using model::OutcomeKind;
using testing::bench_task;
using testing::counter_task;
using testing::lamps_task;
using testing::logistics_task;
using testing::make_task;

bool valid(const Task& task, const model::Plan& plan) {
  PlanText text;
  text.actions = plan.actions;
  text.lines.assign(plan.actions.size(), 0);
  return validate(task, text).valid;
}

model::Outcome optimal(const Task& task) {
  Options options;
  options.optimal = true;
  return solve(task, options);
}

TEST(Solve, WhenBenchIsOptimized_Then108In17StepsIsProved) {
  const Task task = bench_task();
  const model::Outcome outcome = optimal(task);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_EQ(outcome.plan->cost, 108.0);
  EXPECT_EQ(outcome.plan->bound, 108.0);
  EXPECT_EQ(outcome.plan->actions.size(), 17u);
  EXPECT_TRUE(outcome.plan->proved_optimal);
  EXPECT_TRUE(valid(task, *outcome.plan));
  ASSERT_TRUE(outcome.plan->orderings.has_value());
  EXPECT_FALSE(outcome.plan->orderings->empty());
}

TEST(Solve, WhenCostDependsOnTheLoad_Then139IsProved) {
  const Task task = bench_task("_load");
  const model::Outcome outcome = optimal(task);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_EQ(outcome.plan->cost, 139.0);
  EXPECT_EQ(outcome.plan->actions.size(), 19u);
  EXPECT_TRUE(valid(task, *outcome.plan));
}

TEST(Solve, WhenCalledTwice_ThenTheSamePlan) {
  const Task task = bench_task();
  const model::Outcome first = optimal(task);
  const model::Outcome second = optimal(task);
  EXPECT_EQ(first.plan->actions, second.plan->actions);
  EXPECT_EQ(first.plan->orderings, second.plan->orderings);
  EXPECT_EQ(first.expanded, second.expanded);
}

TEST(Solve, WhenAnytime_ThenImprovementsFallAndEndInTheProof) {
  const Task task = bench_task();
  std::vector<double> costs;
  Options options;
  options.on_improvement = [&](const model::Plan& plan) { costs.push_back(plan.cost); };
  const model::Outcome outcome = solve(task, options);
  EXPECT_EQ(outcome.kind, OutcomeKind::Solved);
  ASSERT_FALSE(costs.empty());
  for (std::size_t i = 1; i < costs.size(); ++i) EXPECT_LE(costs[i], costs[i - 1]);
  EXPECT_EQ(costs.back(), 108.0);
}

TEST(Solve, WhenFirstOnly_ThenAValidPlanWithoutProof) {
  const Task task = bench_task();
  Options options;
  options.first_only = true;
  const model::Outcome outcome = solve(task, options);
  ASSERT_TRUE(outcome.plan.has_value());
  EXPECT_FALSE(outcome.plan->proved_optimal);
  EXPECT_TRUE(valid(task, *outcome.plan));
}

TEST(Solve, WhenActionsAreExcluded_ThenThePlanIsTheBestWithoutThemOrThereIsNone) {
  const Task task = counter_task("(= (n) 7)");
  Options options;
  options.optimal = true;
  options.excluded = [](const model::GroundAction& action) { return action.name == "three"; };
  const model::Outcome ones = solve(task, options);
  ASSERT_TRUE(ones.plan);
  EXPECT_TRUE(ones.plan->proved_optimal);
  EXPECT_EQ(ones.plan->cost, 7.0);
  EXPECT_EQ(optimal(task).plan->cost, 5.0);
  options.excluded = [](const model::GroundAction& action) { return action.name == "one"; };
  EXPECT_EQ(solve(task, options).kind, OutcomeKind::Infeasible);
}

// Only the pump of a1 can serve c1.
TEST(Solve, WhenTheGoalNeedsWhatIsExcluded_ThenItIsInfeasibleAtOnce) {
  Options options;
  options.optimal = true;
  options.excluded = [](const model::GroundAction& action) {
    return action.name.ends_with("_order") && action.arguments.at(1) == "c1";
  };
  const model::Outcome outcome = solve(bench_task(), options);
  EXPECT_EQ(outcome.kind, OutcomeKind::Infeasible);
  EXPECT_FALSE(outcome.plan);
}

TEST(Solve, WhenReplannedFromAnObservedState_ThenThePlanStartsThere) {
  const Task task = bench_task();
  State state = task.initial();
  state.assign("(level a1)", 4.0);
  state.set("(is-at v1 f1)", false);
  state.set("(is-at v1 a2)", true);
  state.assign("(lev v1)", 9.0);
  const auto changed = task.with_initial(state);
  ASSERT_TRUE(changed.has_value());
  const model::Outcome outcome = optimal(*changed);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_TRUE(valid(*changed, *outcome.plan));
  EXPECT_FALSE(valid(task, *outcome.plan));
}

TEST(Solve, WhenTheDemandGrowsAfterDelivery_ThenTheRestIsDelivered) {
  const Task task = bench_task();
  State state = task.initial();
  state.assign("(received c1)", 7.0);
  state.assign("(demand c1)", 9.0);
  const auto changed = task.with_initial(state);
  const model::Outcome outcome = optimal(*changed);
  ASSERT_TRUE(outcome.plan.has_value());
  const auto trace = simulate(*changed, *outcome.plan);
  EXPECT_EQ(trace->states.back().value("(received c1)"), 9.0);
}

TEST(Solve, WhenALevelCannotBeReached_ThenTheGoalIsNamedWithItsRange) {
  const auto task = bench_task().with_goal("(and (is-at v1 f1) (= (level a2) 20))");
  const model::Outcome outcome = solve(*task);
  EXPECT_EQ(outcome.kind, OutcomeKind::Infeasible);
  EXPECT_NE(outcome.reason.find("(= (level a2) 20)"), std::string::npos) << outcome.reason;
  EXPECT_NE(outcome.reason.find("between 2 and 10"), std::string::npos) << outcome.reason;
}

TEST(Solve, WhenOnlySearchCanProve_ThenInfeasibleAfterAllStates) {
  // Steps of 3 never meet an even multiple of 2 within the range, which no interval can tell.
  const Task task = make_task(R"((define (domain d) (:requirements :numeric-fluents) (:functions (n))
    (:action three :parameters () :precondition (<= (n) 30) :effect (increase (n) 3))))",
                              "(define (problem p) (:domain d) (:init (= (n) 0)) (:goal (= (n) 10)))");
  const model::Outcome outcome = solve(task);
  EXPECT_EQ(outcome.kind, OutcomeKind::Infeasible);
  EXPECT_NE(outcome.reason.find("searched"), std::string::npos) << outcome.reason;
}

TEST(Solve, WhenTheGoalHoldsAlready_ThenTheEmptyPlanIsOptimal) {
  const Task task = counter_task("(>= (n) 0)");
  const model::Outcome outcome = optimal(task);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_TRUE(outcome.plan->actions.empty());
  EXPECT_EQ(outcome.plan->cost, 0.0);
}

TEST(Solve, WhenCounting_ThenCostBeforeLength) {
  // 10 = 3 + 3 + 3 + 1 costs 7 in 4 steps.
  const model::Outcome outcome = optimal(counter_task("(= (n) 10)"));
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_EQ(outcome.plan->cost, 7.0);
  EXPECT_EQ(outcome.plan->actions.size(), 4u);
}

TEST(Solve, WhenThereIsNoMetric_ThenTheShortestPlan) {
  const model::Outcome outcome = optimal(counter_task("(= (n) 8)", ""));
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_EQ(outcome.plan->cost, 4.0);
  EXPECT_EQ(outcome.plan->actions.size(), 4u);
}

TEST(Solve, WhenTheMetricIsTotalTime_ThenTheShortestPlan) {
  const model::Outcome outcome = optimal(counter_task("(= (n) 9)", "(:metric minimize (total-time))"));
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_EQ(outcome.plan->cost, 3.0);
}

TEST(Solve, WhenMaximizing_ThenTheLargestReachableValue) {
  // The metric reads the state itself: n can reach 100 within its bounds.
  const Task task = counter_task("(>= (n) 5)", "(:metric maximize (n))");
  const model::Outcome outcome = optimal(task);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_EQ(outcome.plan->cost, 100.0);
  EXPECT_TRUE(outcome.plan->proved_optimal);
}

// Driving in circles is paid for: the way to a state gets better and better and must never lead through
// itself.
TEST(Solve, WhenActionsCanEarnForEver_ThenTheBudgetEndsTheSearchWithAPlan) {
  const std::string cell = STEPWRIGHT_SOURCE_DIR "/tests/cells/bench/";
  auto problem = read_source(cell + "problem.pddl");
  ASSERT_TRUE(problem);
  const std::size_t place = problem->text.find("minimize");
  ASSERT_NE(place, std::string::npos);
  problem->text.replace(place, 8, "maximize");
  const auto task = parse_task(*read_source(cell + "domain.pddl"), *problem);
  ASSERT_TRUE(task);
  Options options;
  options.budget.time = std::chrono::milliseconds(500);
  const model::Outcome outcome = solve(*task, options);
  EXPECT_EQ(outcome.kind, OutcomeKind::Exhausted);
  ASSERT_TRUE(outcome.plan);
  EXPECT_TRUE(valid(*task, *outcome.plan));
  EXPECT_FALSE(outcome.plan->proved_optimal);
}

// 20^8 bindings: nobody waits for the last one.
TEST(Solve, WhenQuantifiersMultiplyOut_ThenTheBudgetEndsTheGrounding) {
  std::string objects;
  for (int i = 0; i < 20; ++i) objects += " o" + std::to_string(i);
  for (const std::string goal :
       {"(forall (?a ?b ?c ?d ?e ?f ?g ?h) (or (on ?a ?b) (on ?c ?d) (on ?e ?f) (on ?g ?h)))",
        "(exists (?a ?b ?c ?d ?e ?f ?g ?h) (and (on ?a ?b) (on ?c ?d) (on ?e ?f) (on ?g ?h) (never ?a)))"}) {
    const Task task =
        make_task(R"((define (domain d) (:requirements :adl) (:predicates (on ?a ?b) (never ?a))
      (:action put :parameters (?a ?b) :effect (on ?a ?b))))",
                  "(define (problem p) (:domain d) (:objects" + objects + ") (:init) (:goal " + goal + "))");
    Options options;
    options.budget.time = std::chrono::milliseconds(100);
    const model::Outcome outcome = solve(task, options);
    EXPECT_EQ(outcome.kind, OutcomeKind::Exhausted);
    EXPECT_EQ(outcome.reason, "the time budget ended");
  }
}

// 50 over what was postponed has no value as long as nothing is: only the end counts.
TEST(Solve, WhenTheMetricIsUndefinedOnTheWay_ThenItsValueAtTheEndCounts) {
  const Task task = counter_task("(>= (n) 5)", "(:metric minimize (/ 60 (n)))");
  Options options;
  options.budget.time = std::chrono::milliseconds(300);
  const model::Outcome outcome = solve(task, options);
  ASSERT_TRUE(outcome.plan) << outcome.reason;
  EXPECT_TRUE(valid(task, *outcome.plan));
  EXPECT_LE(outcome.plan->cost, 12.0);
}

TEST(Solve, WhenTheMetricFallsAndRises_ThenTheProofIsStillSound) {
  // Stopping early costs less effort but leaves a fine of 10 per unit missing to 20.
  const Task task = counter_task("(>= (n) 4)", "(:metric minimize (+ (effort) (* 10 (- 20 (n)))))");
  const model::Outcome outcome = optimal(task);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  // n = 100: 33 threes and a one cost 67, the "fine" is -800.
  EXPECT_EQ(outcome.plan->cost, 67.0 - 800.0);
}

TEST(Solve, WhenAnActionPaysBack_ThenTheOptimumIsFound) {
  const Task task =
      make_task(R"((define (domain d) (:requirements :strips :negative-preconditions :numeric-fluents)
    (:predicates (sold) (done)) (:functions (spent))
    (:action sell :parameters () :precondition (not (sold)) :effect (and (sold) (decrease (spent) 5)))
    (:action finish :parameters () :precondition (not (done)) :effect (and (done) (increase (spent) 2)))))",
                R"((define (problem p) (:domain d) (:init (= (spent) 0)) (:goal (done))
    (:metric minimize (spent))))");
  const model::Outcome outcome = optimal(task);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_EQ(outcome.plan->cost, -3.0);
  EXPECT_EQ(outcome.plan->actions.size(), 2u);
}

TEST(Solve, WhenCostCanFallForEver_ThenNoProofIsClaimed) {
  const Task task =
      make_task(R"((define (domain d) (:requirements :strips :negative-preconditions :numeric-fluents)
    (:predicates (up)) (:functions (spent))
    (:action raise :parameters () :precondition (not (up)) :effect (and (up) (decrease (spent) 2)))
    (:action lower :parameters () :precondition (up) :effect (and (not (up)) (increase (spent) 1)))))",
                R"((define (problem p) (:domain d) (:init (= (spent) 0)) (:goal (up))
    (:metric minimize (spent))))");
  const model::Outcome outcome = optimal(task);
  EXPECT_EQ(outcome.kind, OutcomeKind::Exhausted);
  ASSERT_TRUE(outcome.plan.has_value());
  EXPECT_FALSE(outcome.plan->proved_optimal);
  EXPECT_NE(outcome.reason.find("without end"), std::string::npos);
}

TEST(Solve, WhenPackagesSwap_ThenTheTruckDoesOneRound) {
  const Task task = logistics_task(5);
  const model::Outcome outcome = optimal(task);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_EQ(outcome.plan->actions.size(), 12u);  // 8 drives, 2 loads, 2 unloads
  EXPECT_TRUE(valid(task, *outcome.plan));
}

TEST(Solve, WhenEffectsAreConditional_ThenTheyToggleTogether) {
  // The kitchen's lamp is on already, so one toggle of the hall suffices after the power.
  const Task task = lamps_task("(forall (?l - lamp) (on ?l))");
  const model::Outcome outcome = optimal(task);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_EQ(outcome.plan->actions.size(), 2u);
  EXPECT_TRUE(valid(task, *outcome.plan));
}

TEST(Solve, WhenTheGoalIsADisjunction_ThenTheNearestOptionIsTaken) {
  const Task task =
      lamps_task("(or (and (on a) (on b)) (and (not (on a)) (powered)) (exists (?l - lamp) (not (on ?l))))");
  const model::Outcome outcome = optimal(task);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_TRUE(outcome.plan->actions.empty());
}

TEST(Solve, WhenTheGoalIsAnImplication_ThenEitherWayCounts) {
  const Task task = lamps_task("(and (imply (on a) (on b)) (powered))");
  const model::Outcome outcome = optimal(task);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_EQ(outcome.plan->actions.size(), 2u);
  EXPECT_TRUE(valid(task, *outcome.plan));
}

TEST(Solve, WhenCancelled_ThenItSaysSo) {
  const std::atomic<bool> cancel{true};
  Options options;
  options.cancel = &cancel;
  EXPECT_EQ(solve(bench_task(), options).kind, OutcomeKind::Cancelled);
}

TEST(Solve, WhenCancelledAfterTheFirstPlan_ThenThePlanIsKept) {
  std::atomic<bool> cancel{false};
  Options options;
  options.optimal = true;
  options.cancel = &cancel;
  options.on_improvement = [&](const model::Plan&) { cancel = true; };
  const model::Outcome outcome = solve(bench_task(), options);
  EXPECT_EQ(outcome.kind, OutcomeKind::Cancelled);
  ASSERT_TRUE(outcome.plan.has_value());
  EXPECT_FALSE(outcome.plan->proved_optimal);
  EXPECT_LE(outcome.plan->bound, 108.0);
}

TEST(Solve, WhenMemoryEnds_ThenExhausted) {
  // Ten counters to a hundred each: far more states than one megabyte holds.
  std::string functions, actions, init, goal;
  for (int i = 0; i < 10; ++i) {
    const std::string n = "(n" + std::to_string(i) + ")";
    functions += n;
    init += "(= " + n + " 0)";
    goal += "(= " + n + " 60)";
    actions += "(:action up" + std::to_string(i) + " :parameters () :precondition (<= " + n +
               " 99) :effect (increase " + n + " 1)) (:action twice" + std::to_string(i) +
               " :parameters () :precondition (<= " + n + " 49) :effect (scale-up " + n + " 2))";
  }
  const Task task = make_task(
      "(define (domain d) (:requirements :numeric-fluents) (:functions " + functions + ")" + actions + ")",
      "(define (problem p) (:domain d) (:init " + init + ") (:goal (and " + goal + ")))");
  Options options;
  options.optimal = true;
  options.budget.memory_mb = 1;
  const model::Outcome outcome = solve(task, options);
  EXPECT_EQ(outcome.kind, OutcomeKind::Exhausted);
  EXPECT_NE(outcome.reason.find("memory"), std::string::npos);
}

TEST(Solve, WhenTheGroundTaskIsLargerThanTheMemory_ThenExhaustedBeforeItIsThere) {
  std::string objects;
  for (int i = 0; i < 48; ++i) objects += " o" + std::to_string(i);  // 48 * 48 * 48 operators
  const Task task = make_task(
      R"((define (domain d) (:predicates (joined ?a ?b ?c)) (:action join :parameters (?a ?b ?c)
        :effect (joined ?a ?b ?c))))",
      "(define (problem p) (:domain d) (:objects" + objects + ") (:init) (:goal (joined o1 o2 o3)))");
  Options options;
  options.budget.memory_mb = 12;
  const model::Outcome outcome = solve(task, options);
  EXPECT_EQ(outcome.kind, OutcomeKind::Exhausted);
  EXPECT_NE(outcome.reason.find("memory"), std::string::npos) << outcome.reason;
  EXPECT_FALSE(outcome.plan.has_value());
  EXPECT_LT(outcome.peak_mb, 12.0 * 1.25);
}

TEST(Solve, WhenAFluentHasNoValue_ThenActionsThatNeedItAreNotUsed) {
  const Task task = make_task(R"((define (domain d) (:requirements :strips :numeric-fluents)
    (:predicates (done)) (:functions (x) (y))
    (:action count :parameters () :effect (and (done) (increase (x) 1)))
    (:action set :parameters () :effect (assign (x) 1))))",
                              "(define (problem p) (:domain d) (:init (= (y) 0)) (:goal (done)))");
  const model::Outcome outcome = optimal(task);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved) << outcome.reason;
  EXPECT_EQ(outcome.plan->actions.size(), 2u);
  EXPECT_EQ(outcome.plan->actions[0].name, "set");
}

TEST(Solve, WhenDecimalsAdd_ThenTheyMeetTheirSum) {
  const Task task = make_task(R"((define (domain d) (:requirements :numeric-fluents) (:functions (x))
    (:action a :parameters () :precondition (<= (x) 5) :effect (increase (x) 0.1))))",
                              "(define (problem p) (:domain d) (:init (= (x) 0)) (:goal (= (x) 0.3)))");
  const model::Outcome outcome = optimal(task);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved) << outcome.reason;
  EXPECT_EQ(outcome.plan->actions.size(), 3u);
}

}  // namespace
}  // namespace stepwright::pddl

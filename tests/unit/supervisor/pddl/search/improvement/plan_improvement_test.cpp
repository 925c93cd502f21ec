// What makes plans better, each part alone: it never makes one worse or wrong, and it finds what is plain to
// see.

#include <gtest/gtest.h>

#include <algorithm>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/search/control/plan_runner.h"
#include "supervisor/pddl/search/improvement/action_elimination.h"
#include "supervisor/pddl/search/improvement/cluster_plan.h"
#include "supervisor/pddl/search/improvement/plan_neighbourhood.h"
#include "supervisor/pddl/search/improvement/plan_windows.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

// The logistics chain of sample_tasks.h with a plan by hand.
class PlanImprovement : public ::testing::Test {
 protected:
  static constexpr int kPlaces = 6;

  std::vector<int> plan(const std::vector<std::string>& actions) const {
    std::vector<int> operators;
    for (const std::string& action : actions) {
      for (std::size_t i = 0; i < ground_.operators.size(); ++i) {
        if (model::to_string(action_of(ground_, ground_.operators[i])) == action) {
          operators.push_back(static_cast<int>(i));
        }
      }
    }
    EXPECT_EQ(operators.size(), actions.size());
    return operators;
  }

  // One package after the other, with an idle loop in between.
  std::vector<int> wasteful() const {
    std::vector<std::string> actions = {"(load k1 t p1)"};
    const auto drive = [&](int from, int to) {
      const int step = from < to ? 1 : -1;
      for (int p = from; p != to; p += step) {
        actions.push_back("(drive t p" + std::to_string(p) + " p" + std::to_string(p + step) + ")");
      }
    };
    drive(1, 6);
    actions.push_back("(unload k1 t p6)");
    drive(6, 1);
    drive(1, 3);
    drive(3, 1);
    drive(1, 6);
    actions.push_back("(load k2 t p6)");
    drive(6, 1);
    actions.push_back("(unload k2 t p1)");
    return plan(actions);
  }

  Task task_ = testing::logistics_task(kPlaces);
  GroundTask ground_ = ground_task(task_.definition(), [] { return false; });
  StateSpace space_{ground_};
  SearchControl control_{std::chrono::milliseconds(0), 0, nullptr};
};

TEST_F(PlanImprovement, WhenAPlanHasAnIdleLoop_ThenEliminationTakesItOut) {
  const std::vector<int> before = wasteful();
  EXPECT_EQ(cost_of_plan(space_, before), 28.0);
  const std::vector<int> after = eliminate_actions(space_, before, control_);
  EXPECT_LT(after.size(), before.size());
  EXPECT_EQ(cost_of_plan(space_, after), static_cast<double>(after.size()));
}

TEST_F(PlanImprovement, WhenAPlanDoesNotReachTheGoal_ThenItsCostIsInfinite) {
  std::vector<int> cut = wasteful();
  cut.pop_back();
  EXPECT_EQ(cost_of_plan(space_, cut), kInfinity);
  EXPECT_EQ(cost_of_plan(space_, plan({"(unload k1 t p6)"})), kInfinity);
}

TEST_F(PlanImprovement, WhenAPlanIsClustered_ThenItIsTheSameOperatorsAndStillAPlan) {
  const std::vector<int> before = wasteful();
  std::vector<int> after = cluster_plan(space_, before);
  EXPECT_EQ(cost_of_plan(space_, after), 28.0);
  std::vector<int> sorted = before;
  std::sort(sorted.begin(), sorted.end());
  std::sort(after.begin(), after.end());
  EXPECT_EQ(sorted, after);
}

TEST_F(PlanImprovement, WhenTheNeighbourhoodIsSearched_ThenTheDetourGoes) {
  const LowerBounds bounds(space_, [] { return false; });
  control_.offer(wasteful(), 28.0);
  StopReason reason = StopReason::None;
  PlanNeighbourhood neighbourhood(space_, control_, bounds);
  EXPECT_TRUE(neighbourhood.search(wasteful(), 2000, reason));
  const Incumbent best = control_.best();
  EXPECT_EQ(best.quality.cost, 14.0);
  EXPECT_EQ(cost_of_plan(space_, best.operators), 14.0);
}

TEST_F(PlanImprovement, WhenWindowsArePlannedAnew_ThenTheOptimumIsFound) {
  const RelaxedTask relaxed(space_);
  control_.offer(wasteful(), 28.0);
  StopReason reason = StopReason::None;
  PlanWindows windows(relaxed, control_);
  EXPECT_TRUE(windows.run(20'000, reason));
  const Incumbent best = control_.best();
  EXPECT_EQ(best.quality.cost, 14.0);
  EXPECT_EQ(cost_of_plan(space_, best.operators), 14.0);
}

TEST_F(PlanImprovement, WhenTheControlSaysStop_ThenWindowsStop) {
  const RelaxedTask relaxed(space_);
  control_.offer(wasteful(), 28.0);
  control_.finish();
  StopReason reason = StopReason::None;
  PlanWindows windows(relaxed, control_);
  EXPECT_FALSE(windows.run(20'000, reason));
  EXPECT_EQ(reason, StopReason::Finished);
}

// Three parcels, a van with fuel, a customer who may be put off at ten a parcel as long as he has not got it.
Task van_task() {
  return testing::make_task(
      R"((define (domain van) (:requirements :typing :numeric-fluents :negative-preconditions)
    (:types place parcel)
    (:constants depot - place)
    (:predicates (at ?p - place) (aboard ?k - parcel) (done ?k - parcel) (home ?k - parcel) (goes ?k - parcel ?p - place))
    (:functions (fuel) (bill) (load) (way ?a ?b - place))
    (:action drive :parameters (?a ?b - place) :precondition (and (at ?a) (>= (fuel) (way ?a ?b)))
      :effect (and (not (at ?a)) (at ?b) (decrease (fuel) (way ?a ?b)) (increase (bill) (way ?a ?b))))
    (:action take :parameters (?k - parcel) :precondition (and (at depot) (home ?k) (<= (load) 2))
      :effect (and (not (home ?k)) (aboard ?k) (increase (load) 1)))
    (:action give :parameters (?k - parcel ?p - place) :precondition (and (at ?p) (goes ?k ?p) (aboard ?k))
      :effect (and (not (aboard ?k)) (done ?k) (decrease (load) 1)))
    (:action put-off :parameters (?k - parcel) :precondition (home ?k)
      :effect (and (not (home ?k)) (done ?k) (increase (bill) (* 10 (- 4 (load))))))))",
      R"((define (problem p) (:domain van) (:objects x y - place a b c - parcel)
    (:init (at depot) (home a) (home b) (home c) (goes a x) (goes b y) (goes c x) (= (fuel) 40) (= (bill) 0) (= (load) 0)
           (= (way depot x) 5) (= (way x depot) 5) (= (way depot y) 6) (= (way y depot) 6) (= (way x y) 2) (= (way y x) 2)
           (= (way x x) 1) (= (way y y) 1) (= (way depot depot) 1))
    (:goal (and (done a) (done b) (done c) (at depot)))
    (:metric minimize (bill))))");
}

TEST(PlanWindows, WhenFuelAndPenaltiesAreAtStake_ThenPartsFromAnywhereArePlannedAnew) {
  const Task task = van_task();
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  std::vector<int> plan;
  for (const std::string action :
       {"(put-off a)", "(take b)", "(drive depot y)", "(give b y)", "(drive y depot)", "(take c)",
        "(drive depot x)", "(give c x)", "(drive x depot)"}) {
    for (std::size_t i = 0; i < ground.operators.size(); ++i) {
      if (model::to_string(action_of(ground, ground.operators[i])) == action)
        plan.push_back(static_cast<int>(i));
    }
  }
  ASSERT_EQ(cost_of_plan(space, plan), 62.0);
  ASSERT_TRUE(offer_plan(space, control, plan));
  StopReason reason = StopReason::None;
  PlanWindows windows(relaxed, control);
  for (int turn = 0; turn < 10; ++turn) EXPECT_TRUE(windows.run(2'000, reason));
  const Incumbent best = control.best();
  EXPECT_EQ(best.quality.cost, 13.0);  // all aboard, one round
  EXPECT_EQ(cost_of_plan(space, best.operators), 13.0);
}

}  // namespace
}  // namespace stepwright::pddl

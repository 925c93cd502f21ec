#include "supervisor/pddl/search/portfolio/first_plan.h"

#include <gtest/gtest.h>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/search/control/plan_runner.h"
#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

struct Result {
  SearchStatus status = SearchStatus::Running;
  std::vector<int> plan;
  double cost = kInfinity;  // of the plan, executed
  std::uint64_t expanded = 0;
};

Result first_plan(const Task& task, unsigned threads) {
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  StopReason reason = StopReason::None;
  Result result;
  result.status = FirstPlan(relaxed, control, threads).run(reason);
  result.plan = control.best().operators;
  result.expanded = control.expanded();
  if (control.best().quality.found()) result.cost = cost_of_plan(space, result.plan);
  return result;
}

// Of two doors one shuts the other for ever, and the relaxation does not tell; ten lamps beside them make
// three thousand states. `more`: what else there is.
Task doors(const std::string& predicates, const std::string& actions, const std::string& init) {
  return testing::make_task(
      "(define (domain doors) (:requirements :adl :numeric-fluents) (:types lamp)"
      "(:predicates (left) (right) (a) (b) (lit ?l - lamp)" +
          predicates +
          R"(
    (:action left :parameters () :precondition (not (right)) :effect (and (left) (a)))
    (:action right :parameters () :precondition (not (left)) :effect (and (right) (b)))
    (:action on :parameters (?l - lamp) :precondition (not (lit ?l)) :effect (lit ?l))
    (:action off :parameters (?l - lamp) :precondition (lit ?l) :effect (not (lit ?l))))" +
          actions + ")",
      "(define (problem p) (:domain doors) (:objects c d e f g h i j k l - lamp) (:init " + init +
          ") (:goal (and (a) (b) (forall (?l - lamp) (lit ?l)))))");
}

class FirstPlanOn : public ::testing::TestWithParam<unsigned> {};

TEST_P(FirstPlanOn, WhenNoStateMeetsTheGoal_ThenThatIsProved) {
  const Result facts = first_plan(doors(")", "", ""), GetParam());
  EXPECT_EQ(facts.status, SearchStatus::Exhausted);
  EXPECT_GT(facts.expanded, 300u);  // not by the quick attempt
  const Result numbers = first_plan(
      doors(") (:functions (n))",
            "(:action count :parameters () :precondition (and (<= (n) 3) (a)) :effect (increase (n) 1))"
            "(:action stop :parameters () :precondition (and (>= (n) 3) (lit c)) :effect (not (a)))",
            "(= (n) 0)"),
      GetParam());
  EXPECT_EQ(numbers.status, SearchStatus::Exhausted);
  EXPECT_EQ(numbers.cost, kInfinity);
}

// Two boats and five people in the water, far apart: relaxed plans lead everywhere at once.
Task sailing() {
  return testing::make_task(
      R"((define (domain sailing) (:requirements :typing :numeric-fluents :negative-preconditions)
    (:types boat person)
    (:predicates (rescued ?p - person))
    (:functions (x ?b - boat) (y ?b - boat) (px ?p - person) (py ?p - person) (effort))
    (:action south :parameters (?b - boat) :effect (and (decrease (y ?b) 3) (increase (effort) 1)))
    (:action east :parameters (?b - boat) :effect (and (increase (x ?b) 3) (increase (effort) 2)))
    (:action west :parameters (?b - boat) :effect (and (decrease (x ?b) 3) (increase (effort) 2)))
    (:action north-east :parameters (?b - boat)
      :effect (and (increase (x ?b) 1.5) (increase (y ?b) 1.5) (increase (effort) 3)))
    (:action north-west :parameters (?b - boat)
      :effect (and (decrease (x ?b) 1.5) (increase (y ?b) 1.5) (increase (effort) 3)))
    (:action rescue :parameters (?b - boat ?p - person)
      :precondition (and (not (rescued ?p)) (<= (+ (- (x ?b) (px ?p)) (- (y ?b) (py ?p))) 3.5)
                         (<= (+ (- (x ?b) (px ?p)) (- (py ?p) (y ?b))) 3.5)
                         (<= (+ (- (px ?p) (x ?b)) (- (y ?b) (py ?p))) 3.5)
                         (<= (+ (- (px ?p) (x ?b)) (- (py ?p) (y ?b))) 3.5))
      :effect (and (rescued ?p) (increase (effort) 1)))))",
      R"((define (problem five) (:domain sailing) (:objects b1 b2 - boat p1 p2 p3 p4 p5 - person)
    (:init (= (effort) 0) (= (x b1) -20) (= (y b1) -14) (= (x b2) 39) (= (y b2) -35)
           (= (px p1) -7) (= (py p1) -37) (= (px p2) -22) (= (py p2) -30) (= (px p3) -31) (= (py p3) 18)
           (= (px p4) 30) (= (py p4) -40) (= (px p5) -12) (= (py p5) -16))
    (:goal (and (rescued p1) (rescued p2) (rescued p3) (rescued p4) (rescued p5)))
    (:metric minimize (effort))))");
}

TEST_P(FirstPlanOn, WhenQuickAttemptsFail_ThenTheOtherSearchesFindAPlan) {
  const Result result = first_plan(sailing(), GetParam());
  ASSERT_EQ(result.status, SearchStatus::Found);
  EXPECT_LT(result.cost, kInfinity);
  EXPECT_GT(result.expanded, 600u);  // what two quick attempts take
}

TEST_P(FirstPlanOn, WhenTasksAreRandom_ThenWhatItFindsArePlans) {
  int found = 0;
  for (std::uint32_t seed = 600; seed < 640; ++seed) {
    const testing::RandomTask random = testing::random_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    const Result result = first_plan(random.task, GetParam());
    EXPECT_TRUE(result.status == SearchStatus::Found || result.status == SearchStatus::Exhausted);
    EXPECT_EQ(result.status == SearchStatus::Found, result.cost < kInfinity);
    if (result.status == SearchStatus::Found) ++found;
  }
  EXPECT_GT(found, 10);
}

INSTANTIATE_TEST_SUITE_P(Threads, FirstPlanOn, ::testing::Values(1u, 2u));

TEST(FirstPlan, WhenOnOneThread_ThenTheSamePlanTwice) {
  const Task task = testing::bench_task();
  EXPECT_EQ(first_plan(task, 1).plan, first_plan(task, 1).plan);
}

TEST(FirstPlan, WhenTheControlSaysStop_ThenItStops) {
  const Task task = doors(")", "", "");
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  for (const unsigned threads : {1u, 2u}) {
    SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
    control.finish();
    StopReason reason = StopReason::None;
    EXPECT_EQ(FirstPlan(relaxed, control, threads).run(reason), SearchStatus::Stopped);
    EXPECT_EQ(reason, StopReason::Finished);
  }
}

}  // namespace
}  // namespace stepwright::pddl

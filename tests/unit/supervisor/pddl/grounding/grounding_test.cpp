#include <gtest/gtest.h>

#include <set>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/lifted/lifted_state.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

GroundTask ground_all(const Task& task) {
  return ground_task(task.definition(), [] { return false; });
}

TEST(Grounding, WhenTheBenchIsGrounded_ThenOnlyWhatDecidesIsInTheState) {
  const Task task = testing::bench_task();
  const GroundTask ground = ground_all(task);
  EXPECT_EQ(ground.facts.size(), 3u);  // where the vehicle is
  std::set<std::string> variables;
  for (const Atom& atom : ground.variables) variables.insert(fluent_name(task.definition(), atom));
  EXPECT_EQ(variables, (std::set<std::string>{"(lev v1)", "(level a1)", "(level a2)", "(received c1)",
                                              "(received c2)"}));
  EXPECT_TRUE(ground.potential.is_constant());
  EXPECT_EQ(ground.base_cost, 0.0);
}

TEST(Grounding, WhenPreconditionsLimitALevel_ThenItsBoundsAreTheCapacities) {
  const Task task = testing::bench_task();
  const GroundTask ground = ground_all(task);
  for (std::size_t v = 0; v < ground.variables.size(); ++v) {
    const std::string name = fluent_name(task.definition(), ground.variables[v]);
    if (name == "(level a1)" || name == "(lev v1)") {
      EXPECT_EQ(ground.bounds[v].low, 2.0) << name;
      EXPECT_EQ(ground.bounds[v].high, 10.0) << name;
    }
  }
}

// The precondition speaks of the value before, the bounds of the value after all effects.
TEST(Grounding, WhenEffectsOfOneActionAddUp_ThenBoundsHoldTheirSum) {
  const auto high = [](int effects) {
    std::string effect = "(increase (n) 1)", facts, init;
    for (int i = 0; i < effects; ++i) {
      const std::string fact = "(p" + std::to_string(i) + ")";
      facts += fact;
      init += fact;
      effect += " (when " + fact + " (and (increase (n) 2) (not " + fact + ")))";
    }
    const Task task =
        testing::make_task("(define (domain d) (:requirements :adl :numeric-fluents) (:predicates " + facts +
                               ") (:functions (n)) (:action add :parameters () :precondition (<= (n) 5) "
                               ":effect (and " +
                               effect + ")))",
                           "(define (problem p) (:domain d) (:init (= (n) 5) " + init + ") (:goal (>= (n) " +
                               std::to_string(6 + 2 * effects) + ")))");
    const GroundTask ground = ground_all(task);
    EXPECT_FALSE(ground.unreachable_goal.has_value()) << effects;
    return ground.bounds.front().high;
  };
  EXPECT_EQ(high(0), 6.0);
  EXPECT_EQ(high(1), 8.0);
  EXPECT_EQ(high(4), 14.0);
  EXPECT_GE(high(7), 20.0);
}

TEST(Grounding, WhenAnActionCanNeverRun_ThenItIsLeftOut) {
  // a2 can release 8 at most, so the complete order of 10 is impossible; c1's order of 7 is the only complete
  // one.
  const Task task = testing::bench_task();
  const GroundTask ground = ground_all(task);
  std::vector<std::string> complete;
  for (const GroundOperator& op : ground.operators) {
    const model::GroundAction action = action_of(ground, op);
    if (action.name == "complete_order") complete.push_back(model::to_string(action));
  }
  EXPECT_EQ(complete, std::vector<std::string>{"(complete_order a1 c1 level7)"});
}

TEST(Grounding, WhenCostsDependOnTheState_ThenTheirRangeIsKnown) {
  const Task task = testing::bench_task();
  const GroundTask ground = ground_all(task);
  for (const GroundOperator& op : ground.operators) {
    EXPECT_GE(op.cost.low, 0.0);  // what a partial order postpones is positive by its precondition
  }
  const Task load_task = testing::bench_task("_load");
  const GroundTask load = ground_all(load_task);
  for (const GroundOperator& op : load.operators) {
    if (action_of(load, op).name == "move") {
      EXPECT_GE(op.cost.low, 2.0);  // the vehicle is never empty
      EXPECT_LE(op.cost.high, 20.0);
    }
  }
}

TEST(Grounding, WhenAFluentOnlyCounts_ThenItIsNoVariable) {
  const Task plain = testing::counter_task("(= (n) 10)");
  const GroundTask counting = ground_all(plain);
  EXPECT_EQ(counting.variables.size(), 1u);
  const Task limited = testing::counter_task("(and (= (n) 10) (<= (effort) 8))");
  const GroundTask reading = ground_all(limited);
  EXPECT_EQ(reading.variables.size(), 2u);
}

TEST(Grounding, WhenNumbersGrowForEver_ThenExplorationEnds) {
  const Task task =
      testing::make_task(R"((define (domain d) (:requirements :numeric-fluents) (:functions (x) (y))
    (:action a :parameters () :precondition (<= (x) (+ (y) 1)) :effect (increase (x) 1))
    (:action b :parameters () :precondition (<= (y) (+ (x) 1)) :effect (increase (y) 1))))",
                         R"((define (problem p) (:domain d) (:init (= (x) 0) (= (y) 0))
    (:goal (and (= (x) 100) (= (y) -1)))))");
  const GroundTask ground = ground_all(task);
  ASSERT_TRUE(ground.unreachable_goal.has_value());
  EXPECT_NE(ground.unreachable_goal->find("(= (y) -1)"), std::string::npos);
}

std::string unreachable(const std::string& goal) {
  const Task task =
      testing::make_task(R"((define (domain d) (:requirements :adl :derived-predicates :numeric-fluents)
    (:predicates (at ?p) (road ?a ?b) (used) (lit) (far ?p)) (:functions (n))
    (:derived (far ?p) (and (at ?p) (used)))
    (:action go :parameters (?a ?b) :precondition (and (at ?a) (road ?a ?b))
      :effect (and (at ?b) (not (at ?a)) (when (lit) (used))))
    (:action count :precondition (<= (n) 2) :effect (increase (n) 1))))",
                         "(define (problem p) (:domain d) (:objects x y z)\n (:init (at x) (road x y)"
                         " (= (n) 0))\n (:goal (and (at y) " +
                             goal + ")))");
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  return ground.unreachable_goal.value_or("");
}

TEST(Grounding, WhenAGoalIsUnreachable_ThenItsPlaceAndTheRelaxedReasonAreSaid) {
  const std::pair<const char*, const char*> cases[] = {
      {"(at z)", "none of the actions that could make (at z) true (go) can ever do so"},
      {"(lit)", "no action makes (lit) true"},
      {"(not (road x y))", "no action makes (road x y) false"},
      {"(far y)", "no rule of the derived predicate can ever make (far y) true"},
      {"(> (n) 3)", "(n) stays between 0 and 3"},
      {"(or (at z) (used))",
       "none of its alternatives can hold; none of the actions that could make (at z) true (go) can ever do "
       "so; "
       "none of the actions that could make (used) true (go) can ever do so"},
      {"(forall (?p) (lit))", "what never changes forbids it"},
  };
  for (const auto& [goal, reason] : cases) {
    const std::string text = unreachable(goal);
    SCOPED_TRACE(goal);
    EXPECT_EQ(text.substr(0, 34), "problem.pddl:3:21: P0501: the goal") << text;
    EXPECT_NE(text.find(std::string(" cannot be reached: ") + reason), std::string::npos) << text;
  }
  EXPECT_EQ(unreachable("(= (n) 2)"), "");
}

TEST(Grounding, WhenSeveralGoalsAreUnreachable_ThenEachIsSaidUpToTen) {
  const std::string two = unreachable("(at z) (= (n) 2) (lit)");
  EXPECT_NE(two.find("the goal (at z) cannot be reached: none of the actions"), std::string::npos) << two;
  EXPECT_NE(two.find("; problem.pddl:3:38: P0501: the goal (lit) cannot be reached"), std::string::npos)
      << two;
  std::string goals;
  for (int k = 4; k < 16; ++k) goals += "(> (n) " + std::to_string(k) + ") ";
  const std::string many = unreachable(goals);
  EXPECT_NE(many.find("(> (n) 13)"), std::string::npos) << many;
  EXPECT_EQ(many.find("(> (n) 14)"), std::string::npos) << many;
  EXPECT_NE(many.find("; and 2 more"), std::string::npos) << many;
}

TEST(Grounding, WhenWhatWaitsReadsManyGrowingNumbers_ThenItIsCalledOnceARound) {
  // Both numbers grow in every round, and the condition reads both and has alternatives: were the action
  // called by each of them, the calls would double with every round.
  const Task task = testing::make_task(
      R"((define (domain d) (:requirements :adl :numeric-fluents) (:predicates (done)) (:functions (x) (y))
    (:action more :precondition (and (<= (x) 39) (<= (y) 39)) :effect (and (increase (x) 1) (increase (y) 1)))
    (:action end :precondition (and (or (>= (+ (x) (y)) 80) (>= (- (x) (y)) 100)) (>= (* (x) (y)) 1600))
      :effect (done))))",
      "(define (problem p) (:domain d) (:init (= (x) 0) (= (y) 0)) (:goal (done)))");
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  EXPECT_FALSE(ground.unreachable_goal.has_value());
  EXPECT_EQ(ground.operators.size(), 2u);
}

TEST(Grounding, WhenStopped_ThenCancelled) {
  const Task task = testing::logistics_task(60);
  EXPECT_TRUE(ground_task(task.definition(), [] { return true; }).cancelled);
}

TEST(Grounding, WhenTheListOfOperatorsHasNoRoom_ThenCancelled) {
  const Task task = testing::logistics_task(20);
  std::size_t most = 0;
  const auto never = [] { return false; };
  const auto note = [&](std::size_t bytes) {
    most = std::max(most, bytes);
    return true;
  };
  const GroundTask whole = ground_task(task.definition(), never, note);
  EXPECT_GE(most, whole.operators.size() * sizeof(GroundOperator));
  const auto less = [&](std::size_t bytes) { return bytes < most; };
  EXPECT_TRUE(ground_task(task.definition(), never, less).cancelled);
}

}  // namespace
}  // namespace stepwright::pddl

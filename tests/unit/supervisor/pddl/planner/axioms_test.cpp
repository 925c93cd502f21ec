// Derived predicates: what they mean, that all evaluators agree, and what is wrong with them where.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <string>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/plan/partial_order.h"
#include "supervisor/pddl/plan/validate.h"
#include "supervisor/pddl/planner/solve.h"
#include "supervisor/pddl/search/space/state_space.h"
#include "tests/support/pddl/exhaustive.h"
#include "tests/support/pddl/naive/same_meaning.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

// Blocks with "above" and "clear" derived, as in Thiebaux, Hoffmann and Nebel 2005.
constexpr const char* kBlocks = R"((define (domain blocks)
  (:requirements :adl :derived-predicates)
  (:types block)
  (:predicates (on ?x ?y - block) (ontable ?x - block) (holding ?x - block)
    (above ?x ?y - block) (clear ?x - block) (handempty))
  (:derived (above ?x ?y) (or (on ?x ?y) (exists (?z - block) (and (on ?x ?z) (above ?z ?y)))))
  (:derived (handempty) (forall (?x - block) (not (holding ?x))))
  (:derived (clear ?x) (and (not (holding ?x)) (not (exists (?y - block) (above ?y ?x)))))
  (:action take :parameters (?x - block) :precondition (and (clear ?x) (handempty))
    :effect (and (holding ?x) (not (ontable ?x)) (forall (?y - block) (not (on ?x ?y)))))
  (:action lay :parameters (?x - block) :precondition (holding ?x)
    :effect (and (not (holding ?x)) (ontable ?x)))
  (:action put :parameters (?x ?y - block) :precondition (and (holding ?x) (clear ?y))
    :effect (and (not (holding ?x)) (on ?x ?y)))))";

std::string tower(const std::string& goal) {
  return "(define (problem tower) (:domain blocks) (:objects a b c - block)"
         " (:init (on a b) (on b c) (ontable c)) (:goal " +
         goal + "))";
}

PlanText as_text(const model::Plan& plan) {
  PlanText text;
  text.actions = plan.actions;
  text.lines.assign(text.actions.size(), 0);
  return text;
}

TEST(Axioms, WhenTheTaskIsRead_ThenTheInitialStateHasTheDerivedFacts) {
  const Task task = testing::make_task(kBlocks, tower("(above c a)"));
  for (const char* fact : {"(above a b)", "(above a c)", "(above b c)", "(clear a)", "(handempty)"}) {
    EXPECT_TRUE(task.initial().holds(fact)) << fact;
  }
  EXPECT_FALSE(task.initial().holds("(above b a)"));
  EXPECT_FALSE(task.initial().holds("(clear b)"));
  EXPECT_TRUE(task.warnings().empty()) << result::to_string(task.warnings());
}

TEST(Axioms, WhenEveryStateIsWalkedThrough_ThenAllEvaluatorsAgree) {
  const testing::Walked walked = testing::expect_same_meaning(kBlocks, tower("(above c a)"), 1000);
  EXPECT_EQ(walked.states, 22u);  // 13 piles of three blocks, 9 with one of them in the hand
  EXPECT_GT(walked.goals, 0u);
}

TEST(Axioms, WhenSolved_ThenTheShortestPlanAndItValidates) {
  for (const std::string goal : {"(above c a)", "(and (above c a) (above c b))", "(not (above a c))",
                                 "(forall (?x - block) (clear ?x))"}) {
    const Task task = testing::make_task(kBlocks, tower(goal));
    const auto optimum = testing::exhaustive_optimum(task, 1000);
    ASSERT_TRUE(optimum.has_value()) << goal;
    Options options;
    options.optimal = true;
    const model::Outcome outcome = solve(task, options);
    ASSERT_EQ(outcome.kind, model::OutcomeKind::Solved) << goal << outcome.reason;
    EXPECT_EQ(outcome.plan->actions.size(), optimum->steps) << goal;
    EXPECT_TRUE(validate(task, as_text(*outcome.plan)).valid) << goal;
  }
}

TEST(Axioms, WhenAStateIsObserved_ThenItsDerivedFactsAreDerivedAnew) {
  const Task task = testing::make_task(kBlocks, tower("(above c a)"));
  State observed = task.initial();
  observed.set("(on a b)", false);
  observed.set("(ontable a)", true);
  observed.set("(above c a)", true);  // stale
  const auto changed = task.with_initial(observed);
  ASSERT_TRUE(changed.has_value());
  EXPECT_FALSE(changed->initial().holds("(above a b)"));
  EXPECT_FALSE(changed->initial().holds("(above c a)"));
  EXPECT_TRUE(changed->initial().holds("(clear b)"));
}

TEST(Axioms, WhenAnActionReadsADerivedFact_ThenItWaitsForWhatTheFactDependsOn) {
  const Task task = testing::make_task(kBlocks, tower("(ontable a)"));
  model::Plan plan;
  plan.actions = {{"take", {"a"}}, {"lay", {"a"}}, {"take", {"b"}}};
  const auto orderings = lift_partial_order(task, plan);
  ASSERT_TRUE(orderings.has_value());
  // (take b) reads (clear b) and (handempty), which no action writes by these names.
  EXPECT_EQ(orderings->size(), 2u);
}

std::string objects_named(int count) {
  std::string names;
  for (int i = 0; i < count; ++i) names += " n" + std::to_string(i);
  return names;
}

// A chain of objects; what is linked to a lamp three steps on can be done.
TEST(Axioms, WhenStaticFactsJoinTheVariables_ThenOrderingsTakeStepsOfTheChainOnly) {
  std::string chain;
  for (int i = 0; i + 1 < 60; ++i) chain += "(e n" + std::to_string(i) + " n" + std::to_string(i + 1) + ")";
  const Task task = testing::make_task(
      R"((define (domain d) (:requirements :adl :derived-predicates) (:predicates (e ?x ?y) (on ?x) (linked ?x) (done ?x))
    (:derived (linked ?x) (exists (?a ?b ?c) (and (e ?x ?a) (e ?a ?b) (e ?b ?c) (on ?c))))
    (:action switch :parameters (?x) :effect (on ?x))
    (:action go :parameters (?x) :precondition (linked ?x) :effect (done ?x))))",
      "(define (problem p) (:domain d) (:objects" + objects_named(60) + ") (:init " + chain +
          ") (:goal (done n0)))");
  model::Plan plan;
  plan.actions = {{"switch", {"n7"}}, {"switch", {"n3"}}, {"go", {"n0"}}};
  std::size_t asked = 0;
  const auto orderings = lift_partial_order(task, plan, [&] { return ++asked > 100; });
  ASSERT_TRUE(orderings.has_value()) << result::to_string(orderings.error());
  EXPECT_LE(asked, 2u);  // once for 1024 steps; there are 60 x 60 x 60 combinations
  EXPECT_EQ(*orderings, (std::vector<model::Ordering>{{1, 2}}));  // (go n0) cannot depend on n7
}

// Nothing is known of lamps beforehand: all combinations of them count.
Task ranked_lamps() {
  std::string ranks;
  for (int i = 0; i < 50; ++i) ranks += "(= (rank n" + std::to_string(i) + ") " + std::to_string(i) + ")";
  return testing::make_task(
      R"((define (domain d) (:requirements :adl :derived-predicates :numeric-fluents) (:predicates (on ?x) (lit) (done))
    (:functions (rank ?x))
    (:derived (lit) (exists (?a ?b ?c) (and (< (+ (rank ?a) (rank ?b) (rank ?c)) 1) (on ?c))))
    (:action switch :parameters (?x) :effect (on ?x))
    (:action go :precondition (lit) :effect (done))))",
      "(define (problem p) (:domain d) (:objects" + objects_named(50) + ") (:init " + ranks +
          ") (:goal (done)))");
}

TEST(Axioms, WhenOrderingsAreStopped_ThenNothingMoreIsWorkedOut) {
  model::Plan plan;
  plan.actions = {{"switch", {"n0"}}, {"go", {}}};
  std::size_t asked = 0;
  const auto orderings = lift_partial_order(ranked_lamps(), plan, [&] { return ++asked == 5; });
  ASSERT_FALSE(orderings.has_value());
  EXPECT_EQ(orderings.error()[0].code, "P0311");
  EXPECT_EQ(asked, 5u);
}

TEST(Axioms, WhenTheSearchIsCancelled_ThenThePlanComesWithoutOrderingsThatTakeLong) {
  const Task task = ranked_lamps();
  std::atomic<bool> cancel{false};
  Options options;
  options.cancel = &cancel;
  options.on_improvement = [&](const model::Plan&) { cancel = true; };
  const model::Outcome cancelled = solve(task, options);
  ASSERT_TRUE(cancelled.plan.has_value());
  EXPECT_EQ(cancelled.kind, model::OutcomeKind::Cancelled);
  EXPECT_FALSE(cancelled.plan->orderings.has_value());
  EXPECT_TRUE(solve(task).plan->orderings.has_value());
}

TEST(Axioms, WhenNothingThatItReadsChanges_ThenADerivedFactIsStatic) {
  const Task task = testing::make_task(
      R"((define (domain d) (:requirements :derived-predicates :adl) (:predicates (road ?a ?b) (linked ?a ?b) (at ?p))
    (:derived (linked ?a ?b) (or (road ?a ?b) (exists (?c) (and (road ?a ?c) (linked ?c ?b)))))
    (:action jump :parameters (?a ?b) :precondition (and (at ?a) (linked ?a ?b)) :effect (and (at ?b) (not (at ?a))))))",
      R"((define (problem p) (:domain d) (:objects x y z) (:init (road x y) (road y z) (at x)) (:goal (at z))))");
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  EXPECT_TRUE(ground.axioms.empty());
  EXPECT_EQ(ground.facts.size(), 3u);
  EXPECT_EQ(ground.operators.size(), 3u);
}

// A road over 200 places. Enumerating three places for each of 200 rounds would take minutes for a state.
TEST(Axioms, WhenReachabilityIsOverManyObjects_ThenEachFactIsDerivedFromThoseBeforeIt) {
  constexpr std::size_t kPlaces = 200;
  std::string objects, init = "(at p0)";
  for (std::size_t i = 0; i < kPlaces; ++i) {
    objects += " p" + std::to_string(i);
    if (i > 0) init += " (road p" + std::to_string(i - 1) + " p" + std::to_string(i) + ")";
  }
  const Task task = testing::make_task(
      R"((define (domain d) (:requirements :derived-predicates :adl) (:predicates (road ?a ?b) (linked ?a ?b) (at ?p))
    (:derived (linked ?a ?b) (or (road ?a ?b) (exists (?c) (and (road ?a ?c) (linked ?c ?b)))))
    (:action close :parameters (?a ?b) :precondition (road ?a ?b) :effect (not (road ?a ?b)))
    (:action jump :parameters (?a ?b) :precondition (and (at ?a) (linked ?a ?b)) :effect (and (at ?b) (not (at ?a))))))",
      "(define (problem p) (:domain d) (:objects" + objects + ") (:init " + init + ") (:goal (at p199)))");
  PlanText plan;
  plan.actions = {{"jump", {"p0", "p100"}}, {"close", {"p99", "p100"}}, {"jump", {"p100", "p199"}}};
  plan.lines.assign(plan.actions.size(), 0);
  const Validation validation = validate(task, plan);
  EXPECT_TRUE(validation.valid) << result::to_string(validation.diagnostics);
  const auto linked = [&](std::size_t step) {
    const auto& facts = validation.trace.states[step].facts();
    return std::count_if(facts.begin(), facts.end(),
                         [](const std::string& fact) { return fact.starts_with("(linked "); });
  };
  EXPECT_EQ(linked(1), 200 * 199 / 2);
  EXPECT_EQ(linked(2), 2 * (100 * 99 / 2));
}

// Tests the packed evaluation beyond one word of facts: a line of 100 switches, power reaches as far as all
// of them are on.
TEST(Axioms, WhenThereAreManyDerivedFacts_ThenTheFixpointIsFound) {
  std::string objects, init = "(on s0)";
  for (int i = 0; i < 100; ++i) {
    objects += " s" + std::to_string(i);
    if (i > 0) init += " (next s" + std::to_string(i - 1) + " s" + std::to_string(i) + ")";
  }
  const Task task = testing::make_task(
      R"((define (domain d) (:requirements :derived-predicates :adl) (:predicates (next ?a ?b) (on ?s) (live ?s))
    (:derived (live ?s) (and (on ?s) (not (exists (?b) (next ?b ?s)))))
    (:derived (live ?s) (and (on ?s) (exists (?b) (and (next ?b ?s) (live ?b)))))
    (:action flip :parameters (?s) :effect (and (when (on ?s) (not (on ?s))) (when (not (on ?s)) (on ?s))))))",
      "(define (problem p) (:domain d) (:objects" + objects + ") (:init " + init + ") (:goal (live s99)))");
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  EXPECT_EQ(ground.facts.size() - static_cast<std::size_t>(ground.first_derived), 100u);
  const StateSpace space(ground);
  std::vector<Word> state = space.initial();
  std::vector<Word> next(state.size());
  const auto live = [&] {
    int count = 0;
    for (std::size_t f = static_cast<std::size_t>(ground.first_derived); f < ground.facts.size(); ++f) {
      count += space.fact(state.data(), static_cast<int>(f)) ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(live(), 1);
  for (int i = 99; i >= 1; --i) {
    for (const GroundOperator& op : ground.operators) {
      if (action_of(ground, op).arguments[0] != "s" + std::to_string(i)) continue;
      double cost = 0.0;
      ASSERT_TRUE(space.apply(op, state.data(), next.data(), cost));
      state = next;
    }
    EXPECT_EQ(live(), i == 1 ? 100 : 1);
  }
  EXPECT_TRUE(space.goal(state.data()));
}

struct WrongAxiom {
  const char* name;
  const char* from;
  const char* to;
  std::uint32_t line, column;
  const char* code;
};

class WrongAxioms : public ::testing::TestWithParam<WrongAxiom> {};

TEST_P(WrongAxioms, WhenRead_ThenLocated) {
  std::string domain = kBlocks;
  const std::string from = GetParam().from;
  ASSERT_NE(domain.find(from), std::string::npos);
  domain.replace(domain.find(from), from.size(), GetParam().to);
  const auto task = parse_task({"d.pddl", domain}, {"p.pddl", tower("(above c a)")});
  ASSERT_FALSE(task.has_value());
  const result::Diagnostic& first = task.error().front();
  EXPECT_EQ(first.code, GetParam().code) << result::to_string(task.error());
  EXPECT_EQ(first.where.line, GetParam().line);
  EXPECT_EQ(first.where.column, GetParam().column);
}

const WrongAxiom kWrongAxioms[] = {
    {"Unknown", "(:derived (above", "(:derived (abov", 6, 14, "P0102"},
    {"Arity", "(:derived (clear ?x)", "(:derived (clear ?x ?y)", 8, 14, "P0106"},
    {"Type", "(:derived (clear ?x)", "(:derived (clear ?x - object)", 8, 20, "P0107"},
    {"InEffect", "(and (not (holding ?x)) (on ?x ?y))", "(and (clear ?x) (on ?x ?y))", 14, 19, "P0115"},
    {"Cycle", "(and (on ?x ?z) (above ?z ?y))", "(and (on ?x ?z) (not (above ?z ?y)))", 6, 85, "P0116"},
    {"CycleOverTwo", "(not (holding ?x))))\n  (:derived (clear ?x) (and (not (holding ?x))",
     "(clear ?x)))\n  (:derived (clear ?x) (and (not (handempty))", 8, 35, "P0116"},
    {"NoBody", "(:derived (handempty) (forall (?x - block) (not (holding ?x))))", "(:derived (handempty))", 7,
     24, "P0003"},
};

INSTANTIATE_TEST_SUITE_P(Pddl, WrongAxioms, ::testing::ValuesIn(kWrongAxioms),
                         [](const auto& c) { return std::string(c.param.name); });

TEST(Axioms, WhenADerivedFactIsSetInTheInitialState_ThenP0115) {
  const auto task =
      parse_task({"d", kBlocks}, {"p", R"((define (problem p) (:domain blocks) (:objects a b - block)
  (:init (above a b)) (:goal (clear a))))"});
  ASSERT_FALSE(task.has_value());
  EXPECT_EQ(task.error()[0].code, "P0115");
  EXPECT_EQ(task.error()[0].where.line, 2u);
  EXPECT_EQ(task.error()[0].where.column, 11u);
}

TEST(Axioms, WhenTheRequirementIsMissing_ThenWarning) {
  std::string domain = kBlocks;
  domain.replace(domain.find(" :derived-predicates"), 20, "");
  const auto task = parse_task({"d", domain}, {"p", tower("(above c a)")});
  ASSERT_TRUE(task.has_value());
  ASSERT_EQ(task->warnings().size(), 1u);
  EXPECT_EQ(task->warnings()[0].code, "P0110");
}

// Random axioms over facts, numbers and each other, in three layers that may be recursive within themselves.
class Generator {
 public:
  explicit Generator(std::uint32_t seed) : random_(seed) {}

  std::string domain() {
    std::string text = R"((define (domain d) (:requirements :adl :numeric-fluents :derived-predicates)
      (:types thing) (:predicates (p ?o - thing) (near ?a ?b - thing) (q)
       (d0 ?a ?b - thing) (d1 ?a - thing) (d2)) (:functions (x))
)";
    for (int layer = 0; layer < 3; ++layer) {
      const int rules = 1 + pick(2);
      for (int i = 0; i < rules; ++i) text += rule(layer);
    }
    for (int i = 0; i < 3; ++i) text += action(i);
    return text + ")";
  }

  std::string problem() {
    std::string init = " (= (x) " + std::to_string(pick(4)) + ")";
    for (const std::string pair : {"a b", "b c", "c a", "b a"}) {
      if (pick(3) != 0) init += " (near " + pair + ")";
    }
    if (pick(2) != 0) init += " (p a)";
    if (pick(2) != 0) init += " (q)";
    return "(define (problem r) (:domain d) (:objects a b c - thing) (:init" + init + ") (:goal (and " +
           body(3, "a", "b", 0) + " " + body(3, "b", "c", 0) + ")))";
  }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint32_t>(count)); }

  // A condition that a rule of `layer` may have over the two terms; negation only of lower layers.
  std::string body(int layer, const std::string& a, const std::string& b, int depth) {
    const int choice = pick(depth > 1 ? 9 : 14);
    const auto derived = [&](int most) {
      switch (pick(most)) {
        case 0:
          return "(d0 " + a + " " + b + ")";
        case 1:
          return "(d1 " + (pick(2) == 0 ? a : b) + ")";
        default:
          return std::string("(d2)");
      }
    };
    const std::string inner = "?z" + std::to_string(depth);
    switch (choice) {
      case 0:
        return "(near " + a + " " + b + ")";
      case 1:
        return "(p " + a + ")";
      case 2:
        return "(not (p " + b + "))";
      case 3:
        return "(>= (x) " + std::to_string(pick(5)) + ")";
      case 4:
      case 5:
      case 6:
        return derived(std::min(3, layer + 1));
      case 7:
        return layer > 0 ? "(not " + derived(std::min(3, layer)) + ")" : "(q)";
      case 8:
        return "(not (= " + a + " " + b + "))";
      case 9:
        return "(or " + body(layer, a, b, depth + 1) + " " + body(layer, b, a, depth + 1) + ")";
      case 10:
        return "(exists (" + inner + " - thing) (and (near " + a + " " + inner + ") " +
               body(layer, inner, b, depth + 1) + "))";
      case 11:
        return "(forall (" + inner + " - thing) (or (= " + inner + " " + a + ") " +
               body(layer, inner, b, depth + 1) + "))";
      default:
        return "(and " + body(layer, a, b, depth + 1) + " " + body(layer, a, b, depth + 1) + ")";
    }
  }

  std::string rule(int layer) {
    if (layer == 0) return "(:derived (d0 ?a ?b - thing) " + body(0, "?a", "?b", 0) + ")\n";
    if (layer == 1) return "(:derived (d1 ?a) " + body(1, "?a", "?a", 0) + ")\n";
    return "(:derived (d2) (exists (?a - thing) " + body(2, "?a", "?a", 0) + "))\n";
  }

  std::string action(int index) {
    static const char* effects[] = {"(p ?o)",    "(not (p ?o))", "(q)",
                                    "(not (q))", "(near ?o ?u)", "(not (near ?o ?u))"};
    std::string effect = effects[pick(6)];
    if (pick(2) == 0) effect += std::string(" ") + effects[pick(6)];
    if (pick(3) == 0) effect += " (when " + body(3, "?o", "?u", 1) + " " + effects[pick(6)] + ")";
    if (pick(3) == 0) effect += pick(2) == 0 ? " (assign (x) 0)" : " (assign (x) 4)";
    return "(:action a" + std::to_string(index) + " :parameters (?o ?u - thing) :precondition (and " +
           body(3, "?o", "?u", 1) + " " + body(3, "?u", "?o", 1) + ") :effect (and " + effect + "))\n";
  }

  std::mt19937 random_;
};

class RandomAxioms : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomAxioms, WhenStatesAreWalkedThrough_ThenAllEvaluatorsAgree) {
  std::size_t steps = 0, goals = 0;
  for (std::uint32_t i = 0; i < 12 && !HasFailure(); ++i) {
    Generator generator(GetParam() * 1000 + i);
    const std::string domain = generator.domain();
    const testing::Walked walked = testing::expect_same_meaning(domain, generator.problem(), 60);
    steps += walked.steps;
    goals += walked.goals;
  }
  EXPECT_GT(steps, 200u);
  EXPECT_GT(goals, 0u);
}

TEST_P(RandomAxioms, WhenSolved_ThenAsShortAsEnumerationAndValid) {
  int solvable = 0;
  for (std::uint32_t i = 0; i < 25; ++i) {
    Generator generator(GetParam() * 1000 + 500 + i);
    const std::string domain = generator.domain();
    const std::string problem = generator.problem();
    SCOPED_TRACE(domain + problem);
    const Task task = testing::make_task(domain, problem);
    const auto optimum = testing::exhaustive_optimum(task, 20000);
    Options options;
    options.optimal = true;
    const model::Outcome outcome = solve(task, options);
    ASSERT_EQ(outcome.kind, optimum ? model::OutcomeKind::Solved : model::OutcomeKind::Infeasible)
        << outcome.reason;
    if (!optimum) continue;
    ++solvable;
    EXPECT_EQ(outcome.plan->actions.size(), optimum->steps);
    EXPECT_TRUE(validate(task, as_text(*outcome.plan)).valid);
  }
  EXPECT_GT(solvable, 2);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomAxioms, ::testing::Range(1u, 9u));

}  // namespace
}  // namespace stepwright::pddl

// Properties over random small tasks: the planner's optimum is the enumerated one, and every plan validates.

#include <gtest/gtest.h>

#include <random>

#include "supervisor/pddl/solve.h"
#include "supervisor/pddl/validate.h"
#include "tests/unit/supervisor/pddl/exhaustive.h"
#include "tests/unit/supervisor/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

// Facts (p o) of three objects, fluents (x) and (y) that the actions keep between 0 and 6, costs that may
// depend on the state.
class Generator {
 public:
  explicit Generator(std::uint32_t seed) : random_(seed) {}

  std::string domain() {
    std::string text = R"((define (domain d) (:requirements :adl :numeric-fluents) (:types thing)
      (:predicates (p ?o - thing) (q) (near ?a ?b - thing)) (:functions (x) (y) (cost))
)";
    const int count = 3 + pick(3);
    for (int i = 0; i < count; ++i) text += action(i);
    return text + ")";
  }

  std::string problem() {
    std::string text =
        "(define (problem r) (:domain d) (:objects a b c - thing) (:init (near a b) (near b c) (near c a)";
    if (pick(2) != 0) text += " (p a)";
    if (pick(2) != 0) text += " (q)";
    text += " (= (x) " + number(3) + ") (= (y) " + number(3) + ") (= (cost) 0)) (:goal (and " +
            condition("b") + " " + condition("c") + " " + comparison() + ")) (:metric minimize " +
            (pick(3) == 0 ? "(+ (cost) (* 2 (y)))" : "(cost)") + "))";
    return text;
  }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint32_t>(count)); }
  std::string number(int most) { return std::to_string(pick(most + 1)); }
  std::string fluent() { return pick(2) != 0 ? "(x)" : "(y)"; }

  std::string comparison() {
    static const char* relations[] = {"<", "<=", "=", ">=", ">"};
    const std::string right = pick(4) == 0 ? "(+ (y) 1)" : number(6);
    return std::string("(") + relations[pick(5)] + " (x) " + right + ")";
  }

  std::string condition(const std::string& object) {
    switch (pick(8)) {
      case 0:
        return "(not (p " + object + "))";
      case 1:
        return "(or (q) (p " + object + "))";
      case 2:
        return "(q)";
      case 3:
        return "(exists (?e - thing) (and (p ?e) (not (= ?e " + object + "))))";
      case 4:
        return "(imply (q) " + comparison() + ")";
      case 5:
        return comparison();
      default:
        return "(p " + object + ")";
    }
  }

  // A change that stays between 0 and 6 because of the precondition that comes with it.
  std::string change(std::string& precondition) {
    const std::string f = fluent();
    const std::string amount = std::to_string(1 + pick(3));
    switch (pick(4)) {
      case 0:
        return "(assign " + f + " " + number(6) + ")";
      case 1:
        precondition += " (>= " + f + " " + amount + ")";
        return "(decrease " + f + " " + amount + ")";
      default:
        precondition += " (<= (+ " + f + " " + amount + ") 6)";
        return "(increase " + f + " " + amount + ")";
    }
  }

  std::string action(int index) {
    std::string precondition = "(near ?o ?u)";
    if (pick(2) != 0) precondition += " " + condition("?u");
    std::string effect = pick(3) != 0 ? change(precondition) : "";
    if (pick(2) != 0) effect += pick(3) == 0 ? " (not (p ?o))" : " (p ?o)";
    if (pick(3) == 0) effect += pick(2) != 0 ? " (q)" : " (not (q))";
    if (pick(3) == 0) effect += " (when " + condition("?o") + " (p ?u))";
    if (pick(4) == 0) effect += " (forall (?e - thing) (when (near ?e ?o) (not (p ?e))))";
    effect += " (increase (cost) " + (pick(3) == 0 ? "(* 2 " + fluent() + ")" : number(4)) + ")";
    return "(:action a" + std::to_string(index) + " :parameters (?o ?u - thing) :precondition (and " +
           precondition + ") :effect (and " + effect + "))\n";
  }

  std::mt19937 random_;
};

class RandomTasks : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomTasks, WhenSolved_ThenAsGoodAsEnumerationAndValid) {
  int solvable = 0;
  for (std::uint32_t i = 0; i < 25; ++i) {
    Generator generator(GetParam() * 1000 + i);
    const std::string domain = generator.domain();
    const std::string problem = generator.problem();
    SCOPED_TRACE(domain + problem);
    const Task task = testing::make_task(domain, problem);
    const auto optimum = testing::exhaustive_optimum(task, 20000);
    Options options;
    options.optimal = i % 2 == 0;
    const model::Outcome outcome = solve(task, options);
    if (!optimum) {
      EXPECT_EQ(outcome.kind, model::OutcomeKind::Infeasible) << outcome.reason;
      continue;
    }
    ++solvable;
    ASSERT_EQ(outcome.kind, model::OutcomeKind::Solved) << outcome.reason;
    EXPECT_EQ(outcome.plan->cost, optimum->cost);
    EXPECT_EQ(outcome.plan->actions.size(), optimum->steps);
    PlanText text;
    text.actions = outcome.plan->actions;
    text.lines.assign(text.actions.size(), 0);
    const Validation validation = validate(task, text);
    EXPECT_TRUE(validation.valid) << result::to_string(validation.diagnostics);
    EXPECT_EQ(validation.cost(), outcome.plan->cost);
  }
  EXPECT_GT(solvable, 3);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomTasks, ::testing::Range(1u, 13u));

}  // namespace
}  // namespace stepwright::pddl

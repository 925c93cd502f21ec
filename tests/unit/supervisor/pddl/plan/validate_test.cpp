#include "supervisor/pddl/plan/validate.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "supervisor/pddl/planner/solve.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

using testing::bench_file;
using testing::bench_task;

PlanText read_plan(const std::string& name) {
  auto source = read_source(bench_file("plans/" + name));
  EXPECT_TRUE(source.has_value());
  auto plan = parse_plan(*source);
  EXPECT_TRUE(plan.has_value());
  return *plan;
}

TEST(Validate, WhenThePapersMetricFfPlan_ThenValidWithCost108) {
  const PlanText plan = read_plan("metric_ff.plan");
  const Validation validation = validate(bench_task(), plan);
  EXPECT_TRUE(validation.valid) << result::to_string(validation.diagnostics);
  EXPECT_EQ(plan.actions.size(), 19u);
  EXPECT_EQ(validation.cost(), 108.0);
  EXPECT_EQ(validation.trace.states.size(), 20u);
  EXPECT_EQ(validation.trace.states[1].value("(lev v1)"), 10.0);
  EXPECT_EQ(validation.trace.states[19].value("(level a2)"), 5.0);
}

TEST(Validate, WhenSgplanAsPrinted_ThenStep18FailsAtItsLine) {
  const Validation validation = validate(bench_task(), read_plan("sgplan6_printed.plan"));
  EXPECT_FALSE(validation.valid);
  EXPECT_EQ(validation.failed_step, 18u);
  EXPECT_EQ(validation.failed_condition, "(is-at v1 a2)");
  ASSERT_FALSE(validation.diagnostics.empty());
  EXPECT_EQ(validation.diagnostics[0].code, "P0305");
  EXPECT_EQ(validation.diagnostics[0].where.line, 19u);
}

TEST(Validate, WhenOnlyTheLastStateIsKept_ThenTheJudgementIsTheSame) {
  for (const char* name : {"metric_ff.plan", "sgplan6_printed.plan", "sgplan6_corrected.plan"}) {
    const PlanText plan = read_plan(name);
    const Validation all = validate(bench_task(), plan);
    const Validation last = validate(bench_task(), plan, KeepStates::Last);
    EXPECT_EQ(last.valid, all.valid) << name;
    EXPECT_EQ(last.failed_step, all.failed_step) << name;
    EXPECT_EQ(result::to_string(last.diagnostics), result::to_string(all.diagnostics)) << name;
    EXPECT_EQ(last.trace.cost, all.trace.cost) << name;
    ASSERT_EQ(last.trace.states.size(), 1u) << name;
    EXPECT_EQ(last.trace.states.front(), all.trace.states.back()) << name;
  }
}

TEST(Validate, WhenSgplanStep18IsCorrected_ThenValidWithCost108) {
  const Validation validation = validate(bench_task(), read_plan("sgplan6_corrected.plan"));
  EXPECT_TRUE(validation.valid) << result::to_string(validation.diagnostics);
  EXPECT_EQ(validation.cost(), 108.0);
}

TEST(Validate, WhenMetricFfPlanOnTheLoadVariant_ThenItsTransportCounts) {
  const Validation validation = validate(bench_task("_load"), read_plan("metric_ff.plan"));
  EXPECT_TRUE(validation.valid);
  // Loaded 10, 10, 4, 7 out and four times 2 back, and 100 for what is postponed.
  EXPECT_EQ(validation.cost(), 10 + 2 + 10 + 2 + 4 + 2 + 7 + 2 + 100.0);
}

TEST(Validate, WhenAnyStepIsLeftOut_ThenThePlanIsNotValid) {
  const Task task = bench_task();
  const PlanText plan = read_plan("metric_ff.plan");
  for (std::size_t i = 0; i < plan.actions.size(); ++i) {
    PlanText mutated = plan;
    mutated.actions.erase(mutated.actions.begin() + static_cast<std::ptrdiff_t>(i));
    mutated.lines.erase(mutated.lines.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_FALSE(validate(task, mutated).valid) << "without step " << i + 1;
  }
}

TEST(Validate, WhenAnAmountIsChanged_ThenThePlanIsNotValid) {
  const Task task = bench_task();
  const PlanText plan = read_plan("metric_ff.plan");
  for (std::size_t i = 0; i < plan.actions.size(); ++i) {
    if (plan.actions[i].name == "move" || plan.actions[i].name == "load") continue;
    PlanText mutated = plan;
    mutated.actions[i].arguments.back() = "level1";
    EXPECT_FALSE(validate(task, mutated).valid) << "step " << i + 1;
  }
}

TEST(Validate, WhenACapacityWouldBeExceeded_ThenTheNumbersAreShown) {
  const Task task = bench_task();
  const PlanText plan{"p", {{"load", {"v1", "f1", "level9"}}}, {1}};
  const Validation validation = validate(task, plan);
  EXPECT_EQ(validation.failed_condition, "(<= (+ (lev v1) (amount level9)) (maxlevel v1))");
  EXPECT_NE(validation.failed_values.find("(lev v1) = 2"), std::string::npos);
}

TEST(Validate, WhenTheGoalIsMissed_ThenEachUnmetConjunctIsNamed) {
  const Task task = bench_task();
  const Validation validation = validate(task, {"p", {}, {}});
  EXPECT_EQ(validation.failed_step, 0u);
  EXPECT_EQ(validation.diagnostics.size(), 4u);
  EXPECT_EQ(validation.diagnostics[0].code, "P0310");
  EXPECT_TRUE(validation.goals[0].met);
  EXPECT_FALSE(validation.goals[1].met);
}

// One action whose precondition reads (gauge): static, or changed by another action.
Task gauge_task(const std::string& condition, bool changes, const std::string& value = {}) {
  const std::string other = changes ? "(:action set :precondition (ready) :effect (assign (gauge) 1))" : "";
  return testing::make_task(
      "(define (domain d) (:requirements :adl :numeric-fluents) (:predicates (done) (ready))"
      " (:functions (gauge)) (:action act :precondition " +
          condition + " :effect (done)) " + other + ")",
      "(define (problem p) (:domain d) (:init " + value + ") (:goal (done)))");
}

TEST(Validate, WhenAConditionReadsAnUndefinedFluent_ThenNeitherItNorItsNegationHoldsForValidatorAndPlanner) {
  for (const std::string condition :
       {"(> (gauge) 3)", "(not (> (gauge) 3))", "(not (= (gauge) 3))", "(not (not (< (gauge) 3)))",
        "(imply (> (gauge) 3) (done))", "(not (and (not (done)) (> (gauge) 3)))",
        "(or (done) (not (< (gauge) 3)))"}) {
    for (const bool changes : {false, true}) {
      const Task task = gauge_task(condition, changes);
      const Validation validation = validate(task, {"p", {{"act", {}}}, {1}});
      EXPECT_EQ(validation.failed_step, 1u) << condition << changes;
      EXPECT_EQ(solve(task).kind, model::OutcomeKind::Infeasible) << condition << changes;
    }
  }
  const Validation shown = validate(gauge_task("(not (> (gauge) 3))", true), {"p", {{"act", {}}}, {1}});
  EXPECT_EQ(shown.failed_condition, "(not (> (gauge) 3))");
  EXPECT_EQ(shown.failed_values, "(gauge) = undefined");
}

TEST(Validate, WhenOtherPartsSuffice_ThenAnUndefinedFluentDoesNotMatter) {
  for (const std::string condition :
       {"(or (> (gauge) 3) (not (done)))", "(not (and (> (gauge) 3) (done)))", "(imply (done) (> (gauge) 3))",
        "(forall (?o - object) (> (gauge) 3))"}) {
    const Task task = gauge_task(condition, true);
    EXPECT_TRUE(validate(task, {"p", {{"act", {}}}, {1}}).valid) << condition;
    EXPECT_EQ(solve(task).kind, model::OutcomeKind::Solved) << condition;
  }
}

TEST(Validate, WhenNumbersAreLarge_ThenIntegersAreStillToldApart) {
  const Task task = gauge_task("(> (gauge) 3000000000)", true, "(= (gauge) 3000000001)");
  EXPECT_TRUE(validate(task, {"p", {{"act", {}}}, {1}}).valid);
  EXPECT_EQ(solve(task).kind, model::OutcomeKind::Solved);
}

TEST(Validate, WhenActionsAreUnknown_ThenTheReasonIsSpecific) {
  const Task task = bench_task();
  const auto code = [&](const model::GroundAction& action) {
    return validate(task, {"p", {action}, {1}}).diagnostics[0].code;
  };
  EXPECT_EQ(code({"laod", {"v1", "f1", "level8"}}), "P0301");
  EXPECT_EQ(code({"load", {"v1", "f1"}}), "P0302");
  EXPECT_EQ(code({"load", {"v1", "f9", "level8"}}), "P0303");
  EXPECT_EQ(code({"load", {"v1", "a1", "level8"}}), "P0304");
}

TEST(Validate, WhenPrinted_ThenARowPerStepWithTheFluents) {
  const PlanText plan = read_plan("metric_ff.plan");
  const std::string text = table(plan, validate(bench_task(), plan));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 21);
  EXPECT_NE(text.find("(level a1)"), std::string::npos);
  EXPECT_EQ(text.find("(maxlevel v1)"), std::string::npos);
}

TEST(PlanFile, WhenPrefixesAndCaseVary_ThenTheSameActions) {
  const auto plan =
      parse_plan({"p",
                  "; comment\n(LOAD v1 F1 level8)\n12: (move v1 f1 a1) ; later\n12.003: (Unload "
                  "v1 a1 level8) [1.000]\n\n"});
  ASSERT_TRUE(plan.has_value()) << result::to_string(plan.error());
  ASSERT_EQ(plan->actions.size(), 3u);
  EXPECT_EQ(model::to_string(plan->actions[2]), "(unload v1 a1 level8)");
  EXPECT_EQ(plan->lines, (std::vector<std::uint32_t>{2, 3, 4}));
}

std::string in_one_line(const std::string& text) {
  const auto plan = parse_plan({"p", text});
  if (!plan) return result::to_string(plan.error());
  std::string actions;
  for (const model::GroundAction& action : plan->actions) actions += model::to_string(action);
  return actions;
}

TEST(PlanFile, WhenSeveralActionsStandInALine_ThenAllAreRead) {
  EXPECT_EQ(in_one_line("(a)(b x)\n (c) (d) ; (e)\n"), "(a)(b x)(c)(d)");
  EXPECT_EQ(in_one_line("0: (a) [1] 1.5: (b) [2.0] (c)\n"), "(a)(b)(c)");
  const auto wrong = parse_plan({"p", "(a) b (c)\n(d"});
  ASSERT_FALSE(wrong);
  ASSERT_EQ(wrong.error().size(), 2u);
  EXPECT_EQ(wrong.error()[0].where.column, 5u);
  EXPECT_EQ(wrong.error()[1].code, "P0404");
}

TEST(PlanFile, WhenThereAreTimeStamps_ThenTheyOrderTheActions) {
  EXPECT_EQ(in_one_line("1.0: (b)\n0.0: (a)\n"), "(a)(b)");
  EXPECT_EQ(in_one_line("10: (c) 9: (b)\n1e0: (a) [1]\n"), "(a)(b)(c)");
  EXPECT_EQ(in_one_line("2: (c)\n1: (a)\n1: (b)\n"), "(a)(b)(c)");  // together: as they stand
  EXPECT_EQ(in_one_line("2: (c)\n(d)\n1: (a)\n(b)\n"),
            "(a)(b)(c)(d)");  // without a time: behind the one before
  EXPECT_NE(in_one_line("nan: (b)\n1: (a)\n").find("P0403"), std::string::npos);
  EXPECT_EQ(parse_plan({"p", "1: (b)\n0: (a)"})->lines, (std::vector<std::uint32_t>{2, 1}));
}

TEST(PlanFile, WhenLinesAreMalformed_ThenEachIsLocated) {
  const auto plan = parse_plan({"p", "(load v1\nmove v1 f1\n(move v1 f1 a1) extra\n(ok)\n"});
  ASSERT_FALSE(plan.has_value());
  ASSERT_EQ(plan.error().size(), 3u);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(plan.error()[i].where.line, i + 1);
    EXPECT_EQ(plan.error()[i].code.substr(0, 3), "P04");
  }
}

TEST(PlanFile, WhenACharacterIsWrong_ThenItsLineIsNamed) {
  const auto plan = parse_plan({"p", "(ok)\n; comment\n(move v1 $f1)\n"});
  ASSERT_FALSE(plan.has_value());
  EXPECT_EQ(plan.error()[0].code, "P0402");
  EXPECT_EQ(plan.error()[0].where.line, 3u);
  EXPECT_EQ(plan.error()[0].where.column, 10u);
}

TEST(PlanFile, WhenPrintedAndParsed_ThenTheSamePlan) {
  model::Plan plan;
  plan.actions = {{"load", {"v1", "f1", "level8"}}, {"wait", {}}};
  const auto again = parse_plan({"p", print_plan(plan)});
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->actions, plan.actions);
}

}  // namespace
}  // namespace stepwright::pddl

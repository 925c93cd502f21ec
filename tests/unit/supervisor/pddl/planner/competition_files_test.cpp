// PDDL as the competitions write it and common tools read it, also where the standard says otherwise.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "supervisor/pddl/definition/ast.h"
#include "supervisor/pddl/plan/validate.h"
#include "supervisor/pddl/planner/solve.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

using model::OutcomeKind;

std::string with_body(const std::string& body) {
  return "(define (domain d) (:requirements :adl :numeric-fluents :action-costs)\n" + body + ")";
}

std::string problem(const std::string& sections) {
  return "(define (problem p) (:domain d)\n" + sections + ")";
}

// Solves the task; its only warning, if a code is given, has this code and place.
model::Outcome solved(const Task& task, const std::string& code = {}, std::uint32_t line = 0,
                      std::uint32_t column = 0) {
  EXPECT_EQ(task.warnings().size(), code.empty() ? 0u : 1u) << result::to_string(task.warnings());
  if (!code.empty() && task.warnings().size() == 1) {
    const result::Diagnostic& warning = task.warnings().front();
    EXPECT_EQ(warning.code, code);
    EXPECT_EQ(warning.severity, result::Severity::Warning);
    EXPECT_EQ(warning.where.line, line) << result::to_string(warning);
    EXPECT_EQ(warning.where.column, column) << result::to_string(warning);
  }
  Options options;
  options.optimal = true;
  return solve(task, options);
}

TEST(CompetitionFiles, WhenAQuantifierHidesAParameter_ThenTheInnerOneIsMeant) {
  const std::string domain = with_body(R"((:predicates (p ?x) (q ?x) (r ?x))
(:action act :parameters (?x) :precondition (and (q ?x) (forall (?x) (p ?x)) (not (r ?x)))
 :effect (and (r ?x) (forall (?x) (not (p ?x))))))");
  const std::string all = "(:objects a b) (:goal (r a))";
  const Task good = testing::make_task(domain, problem(all + "(:init (p a) (p b) (q a))"));
  ASSERT_EQ(good.warnings().size(), 2u) << result::to_string(good.warnings());
  EXPECT_EQ(good.warnings()[0].code, "P0108");
  EXPECT_EQ(good.warnings()[0].where.line, 3u);
  EXPECT_EQ(good.warnings()[0].where.column, 66u);
  const model::Outcome outcome = solve(good);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_EQ(simulate(good, *outcome.plan)->states.back().facts(),
            (std::set<std::string, std::less<>>{"(q a)", "(r a)"}));
  EXPECT_EQ(solve(testing::make_task(domain, problem(all + "(:init (p a) (q a))"))).kind,
            OutcomeKind::Infeasible);
}

TEST(CompetitionFiles, WhenADeclarationNamesItsArgumentsAlike_ThenTheyAreTwoAllTheSame) {
  const Task task =
      testing::make_task(with_body(R"((:predicates (in ?obj ?obj) (out ?obj)) (:functions (d ?a))
(:action unload :parameters (?o ?t) :precondition (in ?o ?t) :effect (and (out ?o) (not (in ?o ?t)))))"),
                         problem("(:objects o t) (:init (in o t)) (:goal (out o))"));
  EXPECT_EQ(solved(task, "P0108", 2, 23).plan->actions.size(), 1u);
}

TEST(CompetitionFiles, WhenInitDeniesAFact_ThenItDoesNotHold) {
  const std::string domain = with_body(R"((:predicates (capped ?p))
(:action cap :parameters (?p) :precondition (not (capped ?p)) :effect (capped ?p)))");
  const Task task = testing::make_task(
      domain, problem("(:objects a b) (:init (not (capped a)) (capped b)) (:goal (capped a))"));
  EXPECT_FALSE(task.initial().holds("(capped a)"));
  EXPECT_EQ(solved(task).plan->actions.size(), 1u);
  const auto both = parse_task({"d", domain},
                               {"p", problem("(:objects a) (:init (not (capped a)) (capped a)) (:goal ())")});
  ASSERT_FALSE(both);
  EXPECT_EQ(both.error()[0].code, "P0114");
  EXPECT_EQ(both.error()[0].where.line, 2u);
  EXPECT_EQ(both.error()[0].where.column, 27u);
}

constexpr const char* kCosts = R"((:predicates (g)) (:functions (total-cost) - number)
(:action a :parameters () :effect (and (g) (increase (total-cost) 4))))";

TEST(CompetitionFiles, WhenTotalCostHasNoInitialValue_ThenItStartsAtZero) {
  const Task measured =
      testing::make_task(with_body(kCosts), problem("(:init) (:goal (g)) (:metric minimize (total-cost))"));
  const model::Outcome outcome = solved(measured, "P0118", 1, 18);
  ASSERT_EQ(outcome.kind, OutcomeKind::Solved);
  EXPECT_EQ(outcome.plan->cost, 4.0);
  EXPECT_TRUE(validate(measured, {"p", {{"a", {}}}, {1}}).valid);
  const Task counted = testing::make_task(with_body(kCosts), problem("(:init) (:goal (g))"));
  EXPECT_EQ(solved(counted, "P0118", 1, 18).plan->cost, 1.0);
  EXPECT_TRUE(validate(counted, {"p", {{"a", {}}}, {1}}).valid);
}

TEST(CompetitionFiles, WhenAChangedFluentNeverGetsAValue_ThenItIsNamed) {
  const std::string domain = with_body(R"((:predicates (g ?x)) (:functions (used ?x))
(:action a :parameters (?x) :effect (and (g ?x) (increase (used ?x) 4))))");
  const model::Outcome none =
      solved(testing::make_task(domain, problem("(:objects s t) (:init) (:goal (g t))")), "P0118", 3, 60);
  EXPECT_EQ(none.kind, OutcomeKind::Infeasible);
  EXPECT_NE(none.reason.find("(used s), (used t) never get a value"), std::string::npos) << none.reason;
  // That some of them have one does not help the others.
  const model::Outcome other =
      solved(testing::make_task(domain, problem("(:objects s t) (:init (= (used s) 0)) (:goal (g t))")));
  EXPECT_EQ(other.kind, OutcomeKind::Infeasible);
  EXPECT_NE(other.reason.find("(used t) never gets a value"), std::string::npos) << other.reason;
}

constexpr const char* kConstant = R"((:types t u - object) (:constants c - t) (:predicates (p ?x - t))
(:action a :parameters (?x - t) :effect (p ?x)))";

TEST(CompetitionFiles, WhenAConstantIsListedAmongTheObjects_ThenItIsOneObject) {
  const Task task = testing::make_task(
      with_body(kConstant), problem("(:objects c e - t) (:init) (:goal (forall (?x - t) (p ?x)))"));
  EXPECT_EQ(solved(task, "P0108", 2, 11).plan->actions.size(), 2u);
  const auto other =
      parse_task({"d", with_body(kConstant)}, {"p", problem("(:objects c - u) (:init) (:goal ())")});
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error()[0].code, "P0108");
}

TEST(CompetitionFiles, WhenPredicatesFunctionsAndTypesAreRepeatedAlike_ThenOnceIsMeant) {
  const Task task = testing::make_task(
      with_body(R"((:types t t) (:predicates (p ?x - t) (p ?y - t)) (:functions (total-cost) (total-cost))
(:action a :parameters (?x - t) :effect (and (p ?x) (increase (total-cost) 1))))"),
      problem("(:objects e - t) (:init (= (total-cost) 0)) (:goal (p e))"));
  ASSERT_EQ(task.warnings().size(), 3u) << result::to_string(task.warnings());
  for (const result::Diagnostic& warning : task.warnings()) EXPECT_EQ(warning.code, "P0108");
  EXPECT_EQ(solve(task).kind, OutcomeKind::Solved);
}

// As an either or as two declarations.
TEST(CompetitionFiles, WhenATypeHasTwoSupertypes_ThenItsObjectsAreOfBoth) {
  const std::string rest = R"( (:predicates (swum ?x - ship) (driven ?x - car) (seen ?x - thing))
(:action swim :parameters (?x - ship) :effect (swum ?x))
(:action drive :parameters (?x - car) :effect (driven ?x))
(:action look :parameters (?x - thing) :effect (seen ?x)))";
  const std::string objects = problem(
      "(:objects a - amphibian s - ship c - car) (:init) (:goal (and (swum a) (driven a) (forall (?x - "
      "thing) (seen ?x))))");
  for (const std::string types : {"(:types car ship - thing amphibian - (either car ship))",
                                  "(:types amphibian - car car ship - thing amphibian - ship)"}) {
    const Task task = testing::make_task(with_body(types + rest), objects);
    EXPECT_EQ(solve(task).plan->actions.size(), 5u) << types;
    EXPECT_EQ(
        task.definition().objects_by_type[static_cast<std::size_t>(task.definition().type_ids.at("thing"))],
        (std::vector<int>{0, 1, 2}));
    EXPECT_FALSE(validate(task, {"p", {{"swim", {"c"}}}, {1}}).valid);
  }
  const auto circle =
      parse_task({"d", with_body("(:types car ship - amphibian amphibian - (either thing ship))" + rest)},
                 {"p", objects});
  ASSERT_FALSE(circle);
  EXPECT_EQ(circle.error()[0].code, "P0109");
}

TEST(CompetitionFiles, WhenAQuantifierHasNoVariables_ThenItSaysWhatStandsInIt) {
  const std::string domain = with_body(R"((:predicates (p) (q) (r))
(:action a :parameters () :precondition (and (forall () (p)) (not (exists () (q)))) :effect (forall () (r))))");
  EXPECT_EQ(
      solved(testing::make_task(domain, problem("(:init (p)) (:goal (exists () (r)))"))).plan->actions.size(),
      1u);
  for (const std::string init : {"(:init)", "(:init (p) (q))"}) {
    EXPECT_EQ(solve(testing::make_task(domain, problem(init + "(:goal (r))"))).kind, OutcomeKind::Infeasible);
  }
}

TEST(CompetitionFiles, WhenAProblemTellsTheLengthOfPlans_ThenItBindsNone) {
  const std::string domain = with_body(
      "(:predicates (p) (q)) (:action a :effect (p))"
      "(:action b :precondition (p) :effect (q))");
  for (const std::string length :
       {"(:length (:serial 1) (:parallel 1))", "(:length (:parallel 3))", "(:length)"}) {
    EXPECT_EQ(
        solved(testing::make_task(domain, problem("(:init) (:goal (q))" + length))).plan->actions.size(), 2u);
  }
  const auto wrong = parse_task({"d", domain}, {"p", problem("(:init) (:goal (q)) (:length (:serial q))")});
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error()[0].code, "P0003");
}

TEST(CompetitionFiles, WhenDurationsAreDeclaredAndNotUsed_ThenPlanned) {
  for (const std::string flag : {":durative-actions", ":preferences", ":timed-initial-literals"}) {
    const Task task = testing::make_task(
        "(define (domain d) (:requirements :strips " + flag + ") (:predicates (p)) (:action a :effect (p)))",
        problem("(:init) (:goal (p))"));
    EXPECT_EQ(solved(task, "P0112", 1, 43).kind, OutcomeKind::Solved);
    EXPECT_NE(task.warnings()[0].message.find("'" + flag + "'"), std::string::npos);
  }
}

TEST(CompetitionFiles, WhenAThousandConditionsAreNested_ThenReadAndPlanned) {
  constexpr int kLevels = 1000;
  Options on_two_threads;
  on_two_threads.threads = 2;
  const std::string domain = with_body(
      "(:predicates (p) (q)) (:action a :effect (p))"
      "(:action b :precondition (p) :effect (q))");
  for (const std::string level : {"(and ", "(not ", "(or (not (p)) ", "(forall (?x) "}) {
    std::string goal;
    for (int i = 0; i < kLevels; ++i) goal += level;
    goal += "(q)" + std::string(kLevels, ')');
    const Task task = testing::make_task(domain, problem("(:objects o) (:init (p)) (:goal " + goal + ")"));
    EXPECT_EQ(solve(task, on_two_threads).plan->actions.size(), 1u) << level;
  }
}

}  // namespace
}  // namespace stepwright::pddl

#include "supervisor/htn/task/read_task.h"

#include <gmock/gmock.h>

namespace stepwright::htn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kDomain = R"((define (domain d)
  (:requirements :typing :hierarchy)
  (:types car truck - vehicle place)
  (:constants depot - place)
  (:predicates (at ?v - vehicle ?p - place) (road ?a ?b - place) (seen ?p - place))
  (:functions (total-cost) - number (far ?a ?b - place))
  (:task bring :parameters (?v - vehicle ?p - place))
  (:method there
    :parameters (?v - vehicle ?p - place)
    :task (bring ?v ?p)
    :precondition (at ?v ?p)
    :ordered-subtasks ())
  (:method drive-there
    :parameters (?v - vehicle ?a ?p - place)
    :task (bring ?v ?p)
    :precondition (at ?v ?a)
    :subtasks (and (t1 (drive ?v ?a ?p)) (t2 (bring ?v ?p)))
    :ordering (and (< t1 t2))
    :constraints (not (= ?a ?p)))
  (:action drive
    :parameters (?v - vehicle ?a ?b - place)
    :precondition (and (at ?v ?a) (road ?a ?b))
    :effect (and (not (at ?v ?a)) (at ?v ?b) (increase (total-cost) (far ?a ?b)))))
)";
constexpr const char* kProblem = R"((define (problem p)
  (:domain d)
  (:objects c - car t - truck x - place)
  (:htn :parameters (?v - car) :ordered-subtasks (and (bring ?v x)))
  (:init (at c depot) (road depot x) (= (far depot x) 3))
  (:goal (at c x)))
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

result::Result<ReadTask> read(const std::string& domain, const std::string& problem,
                              const std::vector<std::string>& external = {}) {
  return read_task({"domain.hddl", domain}, {"problem.hddl", problem}, external);
}

TEST(ReadTask, WhenAllIsRight_ThenEverythingIsResolved) {
  const auto result = read(kDomain, kProblem);
  ASSERT_TRUE(result) << result::to_string(result.error());
  EXPECT_TRUE(result->warnings.empty()) << result::to_string(result->warnings);
  const PlanningTask& task = result->task;
  EXPECT_EQ(task.domain_name, "d");
  ASSERT_EQ(task.tasks.size(), 2u);
  EXPECT_THAT(task.tasks[0].methods, ElementsAre(0, 1));
  const Method& drive = task.methods[1];
  ASSERT_EQ(drive.subtasks.size(), 2u);
  EXPECT_TRUE(drive.subtasks[0].primitive);
  EXPECT_THAT(drive.subtasks[0].terms, ElementsAre(0, 1, 2));
  EXPECT_FALSE(drive.subtasks[1].primitive);
  EXPECT_THAT(drive.task_terms, ElementsAre(0, 2));
  EXPECT_EQ(task.methods[task.root].parameters.size(), 1u);
  EXPECT_TRUE(task.predicates[0].changes);
  EXPECT_FALSE(task.predicates[1].changes);
  EXPECT_EQ(task.facts.size(), 2u);
  EXPECT_EQ(task.values.size(), 1u);
  EXPECT_EQ(task.actions[0].costs.size(), 1u);
}

TEST(ReadTask, WhenSubtasksAreOrderedByLabels_ThenTheyAreSorted) {
  const std::string domain =
      replaced(replaced(kDomain, "(and (t1 (drive ?v ?a ?p)) (t2 (bring ?v ?p)))",
                        "(and (t2 (bring ?v ?p)) (t3 (bring ?v ?p)) (t1 (drive ?v ?a ?p)))"),
               "(and (< t1 t2))", "(and (< t2 t3) (< t1 t2) (< t1 t3))");
  const auto result = read(domain, kProblem);
  ASSERT_TRUE(result) << result::to_string(result.error());
  EXPECT_TRUE(result->task.methods[1].subtasks[0].primitive);
}

TEST(ReadTask, WhenAWiderTypeIsGiven_ThenItsObjectsAreChecked) {
  const std::string domain =
      replaced(kDomain, "(?v - vehicle ?a ?b - place)\n", "(?v - car ?a ?b - place)\n");
  const auto result = read(domain, kProblem);
  ASSERT_TRUE(result) << result::to_string(result.error());
  const auto& parts = result->task.methods[1].condition.parts;
  EXPECT_EQ(parts.back().kind, ConditionKind::OfType);
}

TEST(ReadTask, WhenAPredicateIsExternal_ThenItsLiteralsStandApart) {
  const auto result = read(kDomain, kProblem, {"road"});
  ASSERT_FALSE(result);  // it has a fact
  EXPECT_EQ(result.error().front().code, "P0607");
  const auto without = read(kDomain, replaced(kProblem, "(road depot x)", ""), {"road"});
  ASSERT_TRUE(without) << result::to_string(without.error());
  EXPECT_EQ(without->task.actions[0].external_conditions.size(), 1u);
  EXPECT_EQ(without->task.actions[0].condition.parts.size(), 1u);
}

// One wrong text and where and how the error must be reported.
struct Case {
  const char* name;
  bool in_domain;
  const char* from;  // the part of the good text that is replaced ...
  const char* to;    // ... by this
  std::uint32_t line, column;
  const char* code;
  const char* part;  // of message or hint
};

class ReadTaskErrors : public testing::TestWithParam<Case> {};

TEST_P(ReadTaskErrors, WhenATextIsWrong_ThenThePlaceIsTold) {
  const Case& wrong = GetParam();
  const auto result = read(wrong.in_domain ? replaced(kDomain, wrong.from, wrong.to) : kDomain,
                           wrong.in_domain ? kProblem : replaced(kProblem, wrong.from, wrong.to));
  ASSERT_FALSE(result);
  const result::Diagnostic& first = result.error().front();
  EXPECT_EQ(first.code, wrong.code) << result::to_string(result.error());
  EXPECT_EQ(first.where.file, wrong.in_domain ? "domain.hddl" : "problem.hddl");
  EXPECT_EQ(first.where.line, wrong.line) << result::to_string(result.error());
  EXPECT_EQ(first.where.column, wrong.column) << result::to_string(result.error());
  EXPECT_THAT(first.message + " / " + first.hint, HasSubstr(wrong.part));
}

INSTANTIATE_TEST_SUITE_P(
    All, ReadTaskErrors,
    testing::Values(
        Case{"Character", true, "(:types", "\"(:types", 3, 3, "P0002", "unexpected"},
        Case{"Token", true, "(:types", "(types", 3, 4, "P0003", "a section"},
        Case{"Twice", false, "(:init", "(:init) (:init", 5, 12, "P0007", "twice"},
        Case{"Section", true, ":task bring", ":tsak bring", 7, 4, "P0008", "':task'"},
        Case{"Type", true, "?p - place)\n    :task (bring ?v ?p)\n    :precondition (at ?v ?p)",
             "?p - palce)\n    :task (bring ?v ?p)\n    :precondition (at ?v ?p)", 9, 36, "P0101", "'place'"},
        Case{"Predicate", true, "(at ?v ?p)\n", "(att ?v ?p)\n", 11, 20, "P0102", "'at'"},
        Case{"Function", true, "(far ?a ?b)", "(farr ?a ?b)", 23, 70, "P0103", "'far'"},
        Case{"Object", false, "(at c depot)", "(at c depo)", 5, 16, "P0104", "'depot'"},
        Case{"Variable", true, "(t2 (bring ?v ?p))", "(t2 (bring ?w ?p))", 17, 53, "P0105", "'?w'"},
        Case{"Arguments", true, "(t2 (bring ?v ?p))", "(t2 (bring ?v))", 17, 47, "P0106", "2 argument"},
        Case{"ArgumentType", false, "(at c depot)", "(at x depot)", 5, 14, "P0107", "'vehicle'"},
        Case{"TwoMethods", true, "drive-there", "there", 13, 12, "P0108", "twice"},
        Case{"Circle", true, "car truck - vehicle", "vehicle - car car truck - vehicle", 3, 11, "P0109",
             "ancestor"},
        Case{"Domain", false, "(:domain d)", "(:domain e)", 2, 12, "P0111", "'e'"},
        Case{"Denied", false, "(road depot x)", "(not (at c depot))", 5, 29, "P0114", "with and without"},
        Case{"UnknownTask", true, "(t2 (bring ?v ?p))", "(t2 (brnig ?v ?p))", 17, 47, "P0601", "'bring'"},
        Case{"TaskOfMethod", true, ":task (bring ?v ?p)\n    :precondition (at ?v ?a)",
             ":task (drive ?v ?a ?p)\n    :precondition (at ?v ?a)", 15, 12, "P0601", "an action"},
        Case{"NoTask", true, "    :task (bring ?v ?p)\n    :precondition (at ?v ?a)",
             "    :precondition (at ?v ?a)", 13, 12, "P0601", ":task"},
        Case{"Partial", true, "(and (< t1 t2))", "()", 17, 5, "P0602", "'t1' and 't2'"},
        Case{"RoundInACircle", true, "(and (< t1 t2))", "(and (< t1 t2) (< t2 t1))", 18, 23, "P0603",
             "circle"},
        Case{"TwoLabels", true, "(t2 (bring", "(t1 (bring", 17, 43, "P0603", "'t1'"},
        Case{"Label", true, "(and (< t1 t2))", "(and (< t1 tt2))", 18, 26, "P0604", "'t2'"},
        Case{"NoNetwork", false, "(:htn :parameters (?v - car) :ordered-subtasks (and (bring ?v x)))", "", 1,
             18, "P0605", ":htn"},
        Case{"Inserted", false, "(:htn ", "(:htn-tihn ", 4, 4, "P0008", "insertion"},
        Case{"Cost", true, "(far ?a ?b))", "-2)", 23, 69, "P0608", "less"},
        Case{"Assigned", true, "(increase (total-cost) (far ?a ?b))", "(assign (total-cost) 2)", 23, 47,
             "P0008", "increase"}),
    [](const testing::TestParamInfo<Case>& tested) { return std::string(tested.param.name); });

TEST(ReadTask, WhenParenthesesAreNestedForEver_ThenTheDepthIsTheError) {
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "(and ";
  const auto result = read(kDomain, replaced(kProblem, "(:goal (at c x))", "(:goal " + deep));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().front().code, "P0006");
}

TEST(ReadTask, WhenATaskHasNoMethod_ThenItIsAWarning) {
  const auto result =
      read(replaced(kDomain, "(:task bring", "(:task rest :parameters ()) (:task bring"), kProblem);
  ASSERT_TRUE(result) << result::to_string(result.error());
  ASSERT_EQ(result->warnings.size(), 1u);
  EXPECT_EQ(result->warnings.front().code, "P0609");
}

}  // namespace
}  // namespace stepwright::htn

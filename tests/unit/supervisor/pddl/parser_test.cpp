#include <gtest/gtest.h>

#include <algorithm>

#include "supervisor/pddl/task.h"
#include "tests/unit/supervisor/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

constexpr const char* kGoodDomain = R"((define (domain d)
  (:requirements :typing :numeric-fluents)
  (:types car place)
  (:predicates (at ?c - car ?p - place))
  (:functions (fuel ?c - car))
  (:action go
    :parameters (?c - car ?a ?b - place)
    :precondition (and (at ?c ?a) (>= (fuel ?c) 1))
    :effect (and (not (at ?c ?a)) (at ?c ?b) (decrease (fuel ?c) 1))))
)";
constexpr const char* kGoodProblem = R"((define (problem p)
  (:domain d)
  (:objects c - car x y - place)
  (:init (at c x) (= (fuel c) 3))
  (:goal (at c y)))
)";

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

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

class BadInput : public ::testing::TestWithParam<Case> {};

TEST_P(BadInput, WhenRead_ThenLocated) {
  const Case& c = GetParam();
  const std::string domain = c.in_domain ? replaced(kGoodDomain, c.from, c.to) : kGoodDomain;
  const std::string problem = c.in_domain ? kGoodProblem : replaced(kGoodProblem, c.from, c.to);
  const auto task = parse_task({"d.pddl", domain}, {"p.pddl", problem});
  ASSERT_FALSE(task.has_value());
  const auto found = std::find_if(task.error().begin(), task.error().end(),
                                  [&](const result::Diagnostic& d) { return d.code == c.code; });
  ASSERT_NE(found, task.error().end()) << result::to_string(task.error());
  EXPECT_EQ(found->where.file, c.in_domain ? "d.pddl" : "p.pddl");
  EXPECT_EQ(found->where.line, c.line) << result::to_string(*found);
  EXPECT_EQ(found->where.column, c.column) << result::to_string(*found);
  EXPECT_NE((found->message + found->hint).find(c.part), std::string::npos) << result::to_string(*found);
}

const Case kCases[] = {
    {"UnexpectedCharacter", true, "(fuel ?c) 1)", "(fuel ?c) $1)", 8, 49, "P0002", "$"},
    {"MissingName", true, "(domain d)", "(domain ?d)", 1, 17, "P0003", "expected the name of the domain"},
    {"EndOfFile", true, "(decrease (fuel ?c) 1))))", "(decrease (fuel ?c) 1))", 10, 1, "P0004", "line 6"},
    {"BadNumber", true, "(fuel ?c) 1))", "(fuel ?c) 1x))", 8, 49, "P0005", "1x"},
    {"SectionTwice", true, "(:types car place)", "(:types car place) (:types bus)", 3, 23, "P0007", ":types"},
    {"Either", true, "(at ?c - car", "(at ?c - (either car place)", 4, 25, "P0008", "either"},
    {"Durative", true, "(:action go", "(:durative-action go", 6, 4, "P0008", "no duration"},
    {"UnknownType", true, "?c - car ?a ?b - place)", "?c - car ?a ?b - plaec)", 7, 35, "P0101", "'place'"},
    {"UnknownPredicate", true, "(and (at ?c ?a)", "(and (att ?c ?a)", 8, 25, "P0102", "'at'"},
    {"UnknownFunction", true, "(>= (fuel ?c)", "(>= (fule ?c)", 8, 40, "P0103", "'fuel'"},
    {"UnknownVariable", true, "(at ?c ?b) (d", "(at ?c ?bb) (d", 9, 42, "P0105", "'?b'"},
    {"Arity", true, "(and (at ?c ?a)", "(and (at ?c)", 8, 25, "P0106", "takes 2"},
    {"TypeMismatch", true, "(and (at ?c ?a)", "(and (at ?a ?c)", 8, 28, "P0107", "'place'"},
    {"TypeTwice", true, "(:types car place)", "(:types car place car)", 3, 21, "P0108", "car"},
    {"TypeCycle", true, "(:types car place)", "(:types car - place place - car)", 3, 11, "P0109", "ancestor"},
    {"SumAsCondition", true, "(>= (fuel ?c) 1)", "(+ (fuel ?c) 1)", 8, 36, "P0003", "a comparison"},
    {"OtherDomain", false, "(:domain d)", "(:domain e)", 2, 12, "P0111", "'e'"},
    {"NoGoal", false, "(:goal (at c y))", "", 1, 18, "P0113", "goal"},
    {"UnknownObject", false, "(at c x)", "(at c xx)", 4, 16, "P0104", "'x'"},
    {"UnknownObjectInGoal", false, "(at c y)", "(at c why)", 5, 16, "P0104", "why"},
    {"TwoValues", false, "(= (fuel c) 3)", "(= (fuel c) 3) (= (fuel c) 4)", 4, 38, "P0114", "fuel"},
    {"ValueNotANumber", false, "(= (fuel c) 3)", "(= (fuel c) x)", 4, 31, "P0003", "a number"},
    {"FunctionAsPredicate", false, "(:goal (at c y))", "(:goal (fuel c))", 5, 11, "P0102", "function"},
    {"ObjectTwice", false, "c - car x", "c - car c x", 3, 21, "P0108", "c"},
    {"NegativeInit", false, "(at c x)", "(not (at c x))", 4, 11, "P0008", "do not hold"},
    {"MetricWord", false, "(:goal (at c y))", "(:goal (at c y)) (:metric least 1)", 5, 29, "P0003",
     "minimize"},
    {"TrailingText", false, "(:goal (at c y)))", "(:goal (at c y))))", 5, 20, "P0003", "too many"},
    {"SwappedFiles", false, "(problem p)", "(domain p)", 1, 10, "P0003", "order"},
};

INSTANTIATE_TEST_SUITE_P(Pddl, BadInput, ::testing::ValuesIn(kCases),
                         [](const auto& c) { return std::string(c.param.name); });

TEST(Parser, WhenInputIsGood_ThenATaskWithItsParts) {
  const auto task = parse_task({"d.pddl", kGoodDomain}, {"p.pddl", kGoodProblem});
  ASSERT_TRUE(task.has_value()) << result::to_string(task.error());
  EXPECT_EQ(task->domain_name(), "d");
  EXPECT_EQ(task->problem_name(), "p");
  EXPECT_TRUE(task->initial().holds("(at c x)"));
  EXPECT_EQ(task->initial().value("(fuel c)"), 3.0);
  EXPECT_EQ(task->goals(), std::vector<std::string>{"(at c y)"});
  EXPECT_TRUE(task->warnings().empty());
}

TEST(Parser, WhenUpperCase_ThenSameTaskAsLowerCase) {
  std::string upper = kGoodProblem;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](char c) { return std::toupper(c); });
  const auto task = parse_task({"d.pddl", kGoodDomain}, {"p.pddl", upper});
  ASSERT_TRUE(task.has_value()) << result::to_string(task.error());
  EXPECT_EQ(task->initial(), parse_task({"", kGoodDomain}, {"", kGoodProblem})->initial());
}

TEST(Parser, WhenSeveralErrors_ThenAllAreReportedInOrder) {
  std::string domain = replaced(kGoodDomain, "(and (at ?c ?a)", "(and (att ?c ?a)");
  domain = replaced(domain, "(decrease (fuel ?c) 1)", "(decrease (fool ?c) 1)");
  const auto task =
      parse_task({"d.pddl", domain}, {"p.pddl", replaced(kGoodProblem, "(at c y)", "(at c z)")});
  ASSERT_FALSE(task.has_value());
  ASSERT_EQ(task.error().size(), 3u) << result::to_string(task.error());
  EXPECT_EQ(task.error()[0].where.line, 8u);
  EXPECT_EQ(task.error()[1].where.line, 9u);
  EXPECT_EQ(task.error()[2].where.file, "p.pddl");
}

TEST(Parser, WhenSyntaxErrorsInTwoSections_ThenBothAreReportedByRecovery) {
  std::string domain = replaced(kGoodDomain, "(:types car place)", "(:types ?car place)");
  domain = replaced(domain, ":parameters (?c", ":parameters (c");
  const auto task = parse_task({"d.pddl", domain}, {"p.pddl", kGoodProblem});
  ASSERT_FALSE(task.has_value());
  EXPECT_EQ(task.error().size(), 2u) << result::to_string(task.error());
}

TEST(Parser, WhenRequirementIsMissing_ThenWarningWithItsPlace) {
  const auto task =
      parse_task({"d.pddl", replaced(kGoodDomain, " :numeric-fluents", "")}, {"p.pddl", kGoodProblem});
  ASSERT_TRUE(task.has_value());
  ASSERT_EQ(task->warnings().size(), 1u);
  EXPECT_EQ(task->warnings()[0].code, "P0110");
  EXPECT_EQ(task->warnings()[0].where.line, 8u);
}

TEST(Parser, WhenNestedTooDeeply_ThenErrorNotCrashInGoalAndEffect) {
  const std::string deep = "(and " + std::string(100000, '(');
  auto task = parse_task({"", kGoodDomain}, {"", replaced(kGoodProblem, "(at c y)", deep)});
  EXPECT_FALSE(task.has_value());
  std::string nested;
  for (int i = 0; i < 5000; ++i) nested += "(and ";
  task = parse_task({"", replaced(kGoodDomain, "(and (not (at", nested + "(not (at")}, {"", kGoodProblem});
  ASSERT_FALSE(task.has_value());
  EXPECT_EQ(task.error()[0].code, "P0006");
}

TEST(Parser, WhenTextIsCutAnywhere_ThenErrorNotCrashAtEveryByte) {
  const std::string domain = kGoodDomain;
  const std::string problem = kGoodProblem;
  for (std::size_t i = 0; i + 3 < domain.size(); ++i) {
    EXPECT_FALSE(parse_task({"d", domain.substr(0, i)}, {"p", problem}).has_value()) << i;
  }
  for (std::size_t i = 0; i + 3 < problem.size(); ++i) {
    EXPECT_FALSE(parse_task({"d", domain}, {"p", problem.substr(0, i)}).has_value()) << i;
  }
}

TEST(Load, WhenFileIsMissing_ThenDiagnosticNamesItAndIsP0001) {
  const auto task = load_task("/nowhere/domain.pddl", "/nowhere/problem.pddl");
  ASSERT_FALSE(task.has_value());
  EXPECT_EQ(task.error()[0].code, "P0001");
  EXPECT_EQ(task.error()[0].where.file, "/nowhere/domain.pddl");
}

TEST(Load, WhenThePathIsAFolder_ThenP0001) {
  const auto source = read_source(::testing::TempDir());
  ASSERT_FALSE(source.has_value());
  EXPECT_EQ(source.error()[0].code, "P0001");
}

TEST(Task, WhenInitialStateNamesUnknown_ThenRejectedWithHint) {
  const Task task = testing::bench_task();
  State state = task.initial();
  state.assign("(levl a1)", 3.0);
  state.set("(is-at v1 a9)", true);
  const auto changed = task.with_initial(state);
  ASSERT_FALSE(changed.has_value());
  EXPECT_EQ(changed.error().size(), 2u);
}

TEST(Task, WhenGoalIsReplaced_ThenCheckedLikeAFileAndUsed) {
  const Task task = testing::bench_task();
  const auto good = task.with_goal("(and (is-at v1 a1) (= (level a1) 4))");
  ASSERT_TRUE(good.has_value());
  EXPECT_EQ(good->goals().size(), 2u);
  EXPECT_FALSE(task.with_goal("(is-at v1 nowhere)").has_value());
  EXPECT_FALSE(task.with_goal("(is-at v1 a1").has_value());
}

}  // namespace
}  // namespace stepwright::pddl

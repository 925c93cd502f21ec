#include <gtest/gtest.h>

#include <algorithm>

#include "supervisor/pddl/syntax/notation.h"
#include "supervisor/pddl/task/task.h"
#include "tests/support/pddl/sample_tasks.h"

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
    {"EitherUnknownForAnObject", false, "c - car", "c - (either car bus)", 3, 17, "P0101", "'bus'"},
    {"Durative", true, "(:action go", "(:durative-action go", 6, 4, "P0008", "no duration"},
    {"UnknownType", true, "?c - car ?a ?b - place)", "?c - car ?a ?b - plaec)", 7, 35, "P0101", "'place'"},
    {"UnknownPredicate", true, "(and (at ?c ?a)", "(and (att ?c ?a)", 8, 25, "P0102", "'at'"},
    {"UnknownFunction", true, "(>= (fuel ?c)", "(>= (fule ?c)", 8, 40, "P0103", "'fuel'"},
    {"UnknownVariable", true, "(at ?c ?b) (d", "(at ?c ?bb) (d", 9, 42, "P0105", "'?b'"},
    {"Arity", true, "(and (at ?c ?a)", "(and (at ?c)", 8, 25, "P0106", "takes 2"},
    {"TypeMismatch", true, "(and (at ?c ?a)", "(and (at ?a ?c)", 8, 28, "P0107", "'place'"},
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
    {"AndInInit", false, "(at c x)", "(and (at c x))", 4, 11, "P0008", "together"},
    {"NegatedNumber", false, "(at c x)", "(not (= (fuel c) 2))", 4, 16, "P0003", "a name"},
    {"NegatedUnknown", false, "(at c x)", "(not (att c x))", 4, 16, "P0102", "'at'"},
    {"MetricWord", false, "(:goal (at c y))", "(:goal (at c y)) (:metric least 1)", 5, 29, "P0003",
     "minimize"},
    {"TrailingText", false, "(:goal (at c y)))", "(:goal (at c y))))", 5, 20, "P0003", "too many"},
    {"HugeNumber", false, "(= (fuel c) 3)", "(= (fuel c) 1e999)", 4, 31, "P0009", "range"},
    {"TinyNumber", false, "(= (fuel c) 3)", "(= (fuel c) 1e-999)", 4, 31, "P0009", "range"},
    {"BelowTheGridInInit", false, "(= (fuel c) 3)", "(= (fuel c) -1e-10)", 4, 31, "P0009", "smaller unit"},
    {"BelowTheGridInAGoal", false, "(at c y)", "(>= (fuel c) 3e-10)", 5, 23, "P0009", "3e-10"},
    {"BesideTheGrid", true, "(fuel ?c) 1))", "(fuel ?c) 2.5e-9))", 8, 49, "P0009", "multiples of 1e-9"},
    {"Preference", false, "(at c y)", "(preference g (at c y))", 5, 11, "P0008", "preferences"},
    {"ZeroDivisor", true, "(fuel ?c) 1))", "(fuel ?c) (/ 1 0)))", 8, 54, "P0117", "zero"},
    {"DivisorMissing", true, "(fuel ?c) 1))", "(fuel ?c) (/ 1)))", 8, 49, "P0106", "two operands"},
    {"ThreeDivisors", true, "(fuel ?c) 1))", "(fuel ?c) (/ 1 2 3)))", 8, 49, "P0106", "not 3"},
    {"NotOfTwo", true, "(not (at ?c ?a))", "(not (at ?c ?a) (at ?c ?b))", 9, 34, "P0003", "')'"},
    {"NotOfNone", false, "(at c y)", "(not)", 5, 10, "P0106", "found 0"},
    {"ImplyOfOne", false, "(at c y)", "(imply (at c y))", 5, 10, "P0106", "2 conditions"},
    {"EitherOfNone", true, "(at ?c - car", "(at ?c - (either)", 4, 32, "P0003", "a type name"},
    {"EitherUnknown", true, "(at ?c - car", "(at ?c - (either car bus)", 4, 25, "P0101", "'bus'"},
    {"ActionTwice", true, "(:action go", "(:action go :effect ()) (:action go", 6, 36, "P0108",
     "declared twice"},
    {"PredicateTwice", true, "?p - place))\n  (:functions", "?p - place) (at ?x))\n  (:functions", 4, 42,
     "P0108", "'at'"},
    {"FunctionTwice", true, "(fuel ?c - car))", "(fuel ?c - car) (fuel))", 5, 32, "P0108", "'fuel'"},
    {"ParameterTwice", true, "?c - car ?a ?b - place)", "?c - car ?a ?a - place)", 7, 30, "P0108", "'?a'"},
    {"VariableShadows", false, "(:goal (at c y))", "(:goal (forall (?p ?p - place) (at c ?p)))", 5, 22,
     "P0108", "'?p'"},
    {"PreconditionTwice", true, ":effect (and (not", ":precondition () :effect (and (not", 9, 5, "P0007",
     "stands twice"},
    {"ObjectAsType", false, "c - car", "c - cra", 3, 17, "P0101", "'car'"},
    {"TypeOfNumber", false, "c - car", "c - 3", 3, 17, "P0003", "a type name"},
    {"AssignToPredicate", true, "(decrease (fuel ?c) 1)", "(decrease (at ?c ?a) 1)", 9, 57, "P0103",
     "predicate"},
    {"AddAFunction", true, "(at ?c ?b) (d", "(fuel ?c) (d", 9, 36, "P0102", "function"},
    {"ConditionInEffect", true, "(at ?c ?b) (d", "(or (at ?c ?b)) (d", 9, 39, "P0003", ""},
    {"WhenWithoutEffect", true, "(at ?c ?b) (d", "(when (at ?c ?b)) (d", 9, 51, "P0003", "an effect"},
    {"NumberAsFact", false, "(at c x)", "(3 c x)", 4, 11, "P0003", "a name"},
    {"VariableInInit", false, "(at c x)", "(at ?c x)", 4, 14, "P0105", "'?c'"},
    {"VariableInMetric", false, "(:goal (at c y))", "(:goal (at c y)) (:metric minimize (fuel ?c))", 5, 44,
     "P0105", "'?c'"},
    {"UnknownSection", true, "(:types", "(:tpyes", 3, 4, "P0008", ":types"},
    {"UnknownInAction", true, ":precondition", ":precondtion", 8, 5, "P0008", ":precondition"},
    {"GoalTwice", false, "(:goal (at c y))", "(:goal (at c y)) (:goal (at c x))", 5, 21, "P0007", ":goal"},
    {"LetterlessVariable", true, "?c - car ?a", "? - car ?a", 7, 18, "P0002", "?"},
    {"QuantifierOfTwo", false, "(:goal (at c y))", "(:goal (exists () (at c y) (at c x)))", 5, 10, "P0106",
     "found 2"},
    {"EmptyMetric", false, "(:goal (at c y))", "(:goal (at c y)) (:metric minimize)", 5, 37, "P0003",
     "a number"},
    {"TypeIsItsOwnParent", true, "(:types car place)", "(:types car - car place)", 3, 11, "P0109",
     "ancestor"},
    {"TimedLiteral", false, "(at c x)", "(at 5 (at c x))", 4, 11, "P0008", "timed initial literals"},
    {"SwappedFiles", false, "(problem p)", "(domain p)", 1, 10, "P0003", "order"},
};

TEST(Reading, WhenThereAreMoreErrorsThanAnyoneReads_ThenTheFirstAndTheNumberOfTheOthers) {
  std::string init;
  for (int i = 0; i < 1000; ++i) init += "(at c nowhere" + std::to_string(i) + ")\n";
  const auto task = parse_task({"d.pddl", kGoodDomain}, {"p.pddl", replaced(kGoodProblem, "(at c x)", init)});
  ASSERT_FALSE(task.has_value());
  ASSERT_EQ(task.error().size(), Reporter::kMost + 1);
  EXPECT_NE(task.error()[49].message.find("nowhere49"), std::string::npos);
  EXPECT_EQ(task.error().back().code, "P0010");
  EXPECT_NE(task.error().back().message.find("950"), std::string::npos);
}

TEST(Reading, WhenWarningsAreMany_ThenTheErrorIsAmongThem) {
  std::string init;
  for (int i = 0; i < 100; ++i) init += "(at c x)\n";
  const auto task =
      parse_task({"d.pddl", kGoodDomain}, {"p.pddl", replaced(kGoodProblem, "(at c x)", init + "(at c q)")});
  ASSERT_FALSE(task.has_value());
  EXPECT_EQ(std::count_if(task.error().begin(), task.error().end(),
                          [](const auto& d) { return d.severity == result::Severity::Error; }),
            1);
}

// 5,000 hints out of 5,000 names each would take many seconds.
TEST(Reading, WhenThousandsOfObjectsAreMisspelt_ThenTheFirstAreHintedAndTheOthersCounted) {
  std::string objects, init;
  for (int i = 0; i < 5'000; ++i) {
    objects += " place" + std::to_string(i);
    init += "(at c plcae" + std::to_string(i) + ")\n";
  }
  const std::string problem = replaced(replaced(kGoodProblem, "x y", "x y" + objects), "(at c x)", init);
  const auto task = parse_task({"d.pddl", kGoodDomain}, {"p.pddl", problem});
  ASSERT_FALSE(task.has_value());
  EXPECT_EQ(task.error()[0].hint, "did you mean 'place0'?");
  EXPECT_NE(task.error().back().message.find("4950"), std::string::npos) << task.error().back().message;
}

TEST(Reading, WhenANameIsAMegabyte_ThenTheMessageCanBeRead) {
  const std::string name(1'000'000, 'x');
  const auto task = parse_task({"d.pddl", kGoodDomain},
                               {"p.pddl", replaced(kGoodProblem, "(at c y)", "(at c " + name + ")")});
  ASSERT_FALSE(task.has_value());
  EXPECT_LT(task.error()[0].message.size(), 500u);
  EXPECT_EQ(task.error()[0].code, "P0104");
}

TEST(Reading, WhenAGroupOfObjectsHasAnUnknownType_ThenItIsSaidOnce) {
  const auto task =
      parse_task({"d.pddl", kGoodDomain}, {"p.pddl", replaced(kGoodProblem, "c - car", "c d e - carr")});
  ASSERT_FALSE(task.has_value());
  EXPECT_EQ(std::count_if(task.error().begin(), task.error().end(),
                          [](const auto& d) { return d.code == "P0101"; }),
            1);
}

TEST(Reading, WhenAVariableHasAnUnknownType_ThenItsUsesAreNoFurtherErrors) {
  const auto task =
      parse_task({"d.pddl", replaced(kGoodDomain, "?c - car ?a", "?c - carr ?a")}, {"p.pddl", kGoodProblem});
  ASSERT_FALSE(task.has_value());
  ASSERT_EQ(task.error().size(), 1u) << result::to_string(task.error());
  EXPECT_EQ(task.error()[0].code, "P0101");
}

TEST(Reading, WhenTheProblemIsOfAnotherDomain_ThenNothingElseIsSaid) {
  const auto task = parse_task({"d.pddl", kGoodDomain}, {"p.pddl", R"((define (problem p) (:domain e)
    (:objects z - zone) (:init (in z)) (:goal (out z))))"});
  ASSERT_FALSE(task.has_value());
  ASSERT_EQ(task.error().size(), 1u) << result::to_string(task.error());
  EXPECT_EQ(task.error()[0].code, "P0111");
}

TEST(Reading, WhenTheFileIsNoText_ThenItIsReadUpToThatByte) {
  const std::string bytes(
      "\x7f"
      "ELF\x02\x01\x01\x00$$$",
      10);
  const auto task = parse_task({"d.pddl", bytes}, {"p.pddl", kGoodProblem});
  ASSERT_FALSE(task.has_value());
  ASSERT_EQ(task.error()[0].code, "P0002");
  EXPECT_NE(task.error()[0].message.find("byte 127"), std::string::npos);
  EXPECT_LE(task.error().size(), 2u) << result::to_string(task.error());
}

TEST(Reading, WhenNeitherFileIsThere_ThenBothAreNamed) {
  const auto task = load_task("/nonexistent/d.pddl", "/nonexistent/p.pddl");
  ASSERT_FALSE(task.has_value());
  ASSERT_EQ(task.error().size(), 2u);
  EXPECT_EQ(task.error()[1].where.file, "/nonexistent/p.pddl");
}

TEST(Reading, WhenAFileHasNoEnd_ThenItIsTooLarge) {
  const auto source = read_source("/dev/zero");
  ASSERT_FALSE(source.has_value());
  EXPECT_EQ(source.error()[0].code, "P0001");
  EXPECT_NE(source.error()[0].message.find("64 MB"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Pddl, BadInput, ::testing::ValuesIn(kCases),
                         [](const auto& c) { return std::string(c.param.name); });

// A metric over a function that no action changes.
result::Diagnostics metric_errors(const std::string& metric, const std::string& values) {
  const auto task = parse_task(
      {"d.pddl",
       R"((define (domain d) (:requirements :numeric-fluents) (:predicates (done)) (:functions (rate) (n))
  (:action work :effect (and (done) (increase (n) 1)))))"},
      {"p.pddl", "(define (problem p) (:domain d) (:init (= (n) 0)" + values +
                     ") (:goal (done))\n(:metric minimize " + metric + "))"});
  return task ? result::Diagnostics{} : task.error();
}

TEST(Numbers, WhenTheyHaveDigitsThatDoNotCount_ThenThatIsSaid) {
  const auto warnings = [](const std::string& number) {
    const auto task =
        parse_task({"d.pddl", replaced(kGoodDomain, "(fuel ?c) 1))", "(fuel ?c) " + number + "))")},
                   {"p.pddl", kGoodProblem});
    EXPECT_TRUE(task.has_value()) << number;
    return task ? task->warnings() : result::Diagnostics{};
  };
  for (const std::string number : {"1e-9", "0.1", "123456789.25", "1e300", "0", "0.000000123"}) {
    EXPECT_TRUE(warnings(number).empty()) << number;
  }
  for (const std::string number : {"1.0000000004", "0.3333333333333"}) {
    const result::Diagnostics said = warnings(number);
    ASSERT_EQ(said.size(), 1u) << number;
    EXPECT_EQ(said[0].code, "P0009");
    EXPECT_EQ(said[0].where.line, 8u);
    EXPECT_EQ(said[0].where.column, 49u);
  }
}

TEST(Metric, WhenItsDivisorIsAndStaysZero_ThenP0117AtTheDivisor) {
  const auto errors = metric_errors("(+ (n) (/ 5 (- (rate) 2)))", " (= (rate) 2)");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].code, "P0117");
  EXPECT_EQ(errors[0].where.line, 2u);
  EXPECT_EQ(errors[0].where.column, 31u);
  EXPECT_NE(errors[0].message.find("(- (rate) 2)"), std::string::npos);
  EXPECT_TRUE(metric_errors("(+ (n) (/ 5 (- (rate) 2)))", " (= (rate) 3)").empty());
  EXPECT_TRUE(metric_errors("(/ 5 (n))", " (= (rate) 3)").empty());  // zero at first only
}

TEST(Metric, WhenItReadsWhatNeverGetsAValue_ThenP0118) {
  const auto errors = metric_errors("(+ (n) (rate))", "");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].code, "P0118");
  EXPECT_EQ(errors[0].where.line, 2u);
  EXPECT_EQ(errors[0].where.column, 26u);
  // What was never given a value cannot be increased.
  const auto increased = parse_task(
      {"d.pddl", kGoodDomain}, {"p.pddl", R"((define (problem p) (:domain d) (:objects c - car x y - place)
    (:init (at c x)) (:goal (at c y)) (:metric minimize (fuel c))))"});
  ASSERT_FALSE(increased.has_value());
  EXPECT_EQ(increased.error()[0].code, "P0118");
}

TEST(Parser, WhenARequirementIsUnknown_ThenWarningWithAHint) {
  const auto task =
      parse_task({"d.pddl", replaced(kGoodDomain, ":typing", ":typing :adll")}, {"p.pddl", kGoodProblem});
  ASSERT_TRUE(task.has_value());
  ASSERT_EQ(task->warnings().size(), 1u);
  EXPECT_EQ(task->warnings()[0].code, "P0112");
  EXPECT_EQ(task->warnings()[0].hint, "did you mean ':adl'?");
}

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

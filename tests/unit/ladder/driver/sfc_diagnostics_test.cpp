// What the compiler says about textual charts: the code, the place and a part of the hint or message.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ladder/driver/compile.h"

namespace {

using stepwright::driver::compile;
using stepwright::driver::CompileInput;
using stepwright::result::Diagnostics;
using ::testing::HasSubstr;

Diagnostics diagnostics_of(const std::string& text) {
  CompileInput input;
  input.texts.push_back({"t.st", text});
  const auto output = compile(input);
  return output ? output->warnings : output.error();
}

struct ChartCase {
  const char* name;
  const char* code;
  std::uint32_t line;
  std::uint32_t column;
  const char* text;
  const char* part;  // of message and hint
};

void PrintTo(const ChartCase& each, std::ostream* out) {
  *out << each.name;
}

// The first line of the chart is line 3.
#define CHART(text) "PROGRAM main\nVAR x, y, lamp : BOOL; n : INT; f : Sub; END_VAR\n" text "\nEND_PROGRAM\n"

constexpr const char* kSub =
    "\nFUNCTION_BLOCK Sub\nINITIAL_STEP S1: END_STEP\nTRANSITION FROM S1 TO S1 := TRUE; "
    "END_TRANSITION\nEND_FUNCTION_BLOCK\n";

const ChartCase kCases[] = {
    {"NoInitialStep", "E0710", 1, 9, CHART("STEP A: END_STEP"), "no initial step"},
    {"StepNamedTwice", "E0712", 4, 6, CHART("INITIAL_STEP A: END_STEP\nSTEP a: END_STEP"), "'a'"},
    {"TransitionNamedTwice", "E0712", 5, 12,
     CHART("INITIAL_STEP A: END_STEP\nTRANSITION t FROM A TO A := x; END_TRANSITION\nTRANSITION t FROM A TO "
           "A := "
           "y; END_TRANSITION"),
     "'t'"},
    {"SourceTwice", "E0718", 4, 1,
     CHART("INITIAL_STEP A: END_STEP\nTRANSITION FROM (A, A) TO A := x; END_TRANSITION"),
     "twice as a source"},
    {"StepNamedAsVariable", "E0721", 3, 14, CHART("INITIAL_STEP lamp: END_STEP"), "name of a variable"},
    {"ActionNamedAsVariable", "E0721", 4, 8,
     CHART("INITIAL_STEP A: lamp(N); END_STEP\nACTION lamp: n := 1; END_ACTION"), "name of a variable"},
    {"TargetNotBool", "E0722", 3, 17, CHART("INITIAL_STEP A: n(N); END_STEP"), "is a INT"},
    {"UnknownTarget", "E0723", 3, 26, CHART("INITIAL_STEP A: lamp(N); lmp(N); END_STEP"), "'lmp'"},
    {"ReturnInAction", "E0724", 4, 8,
     CHART("INITIAL_STEP A: work(N); END_STEP\nACTION work: IF x THEN RETURN; END_IF; END_ACTION"), "'work'"},
    {"UnknownIndicator", "E0725", 3, 17, CHART("INITIAL_STEP A: lamp(N, y, dnoe); END_STEP"), "'dnoe'"},
    {"FlagWritten", "E0726", 4, 8,
     CHART("INITIAL_STEP A: work(N); END_STEP\nACTION work: a.X := TRUE; END_ACTION"), "read-only"},
    {"ActionFlagWritten", "E0726", 4, 8,
     CHART("INITIAL_STEP A: work(N); END_STEP\nACTION work: work.Q := TRUE; END_ACTION"), "work.Q"},
    {"DurationMissing", "E0703", 3, 22, CHART("INITIAL_STEP A: lamp(L); END_STEP"), "needs a duration"},
    {"DurationUnused", "E0703", 3, 25, CHART("INITIAL_STEP A: lamp(N, T#1s); END_STEP"), "takes no duration"},
    {"DurationNotATime", "E0301", 3, 25, CHART("INITIAL_STEP A: lamp(L, n); END_STEP"), "TIME"},
    {"DurationUndeclared", "E0201", 3, 25, CHART("INITIAL_STEP A: lamp(L, wait); END_STEP"), "'wait'"},
    {"PriorityTooLarge", "E0703", 4, 25,
     CHART("INITIAL_STEP A: END_STEP\nTRANSITION (PRIORITY := 70000) FROM A TO A := x; END_TRANSITION"),
     "65535"},
    {"PriorityMisspelt", "E0104", 4, 13,
     CHART("INITIAL_STEP A: END_STEP\nTRANSITION (PRIO := 7) FROM A TO A := x; END_TRANSITION"), "PRIORITY"},
    {"DrawnCondition", "E0107", 4, 24,
     CHART("INITIAL_STEP A: END_STEP\nTRANSITION FROM A TO A : LD x END_TRANSITION"), "PLCopen"},
    {"NoCondition", "E0104", 4, 27,
     CHART("INITIAL_STEP A: END_STEP\nTRANSITION FROM A TO A := ; END_TRANSITION"), "condition"},
    // SFC-F-5
    {"FlagOfAnotherPou", "E0204", 4, 29,
     CHART("INITIAL_STEP A: END_STEP\nTRANSITION FROM A TO A := f.S1.X; END_TRANSITION"), "S1"},
    {"StepUnreachable", "W0701", 4, 6, CHART("INITIAL_STEP A: END_STEP\nSTEP B: END_STEP"), "step 'B'"},
    {"NeverFires", "W0702", 5, 12,
     CHART("INITIAL_STEP A: END_STEP\nTRANSITION t1 FROM A TO A := TRUE; END_TRANSITION\nTRANSITION t2 FROM "
           "A TO A "
           ":= x; END_TRANSITION"),
     "'t2'"},
    {"TokenDoubled", "W0703", 4, 12,
     CHART(
         "INITIAL_STEP A: END_STEP STEP B: END_STEP STEP C: END_STEP\nTRANSITION fork FROM A TO (B, C) := x; "
         "END_TRANSITION\nTRANSITION back FROM B TO A := x; END_TRANSITION\nTRANSITION FROM (B, C) TO A := "
         "x; "
         "END_TRANSITION"),
     "after 'fork', 'back'"},
    {"TokenLost", "W0704", 4, 6,
     CHART("INITIAL_STEP A: END_STEP STEP B: END_STEP\nSTEP C: END_STEP STEP E: END_STEP\nTRANSITION fork "
           "FROM A TO "
           "(B, C) := x; END_TRANSITION\nTRANSITION leave FROM B TO E := x; END_TRANSITION\nTRANSITION FROM "
           "(B, C) "
           "TO A := x; END_TRANSITION"),
     "after 'fork', 'leave' transition B + C -> A waits for step 'B'"},
    {"Deadlock", "W0705", 4, 6,
     CHART(
         "INITIAL_STEP A: END_STEP\nSTEP B: END_STEP STEP C: END_STEP\nTRANSITION t1 FROM A TO B := x; "
         "END_TRANSITION\nTRANSITION t2 FROM A TO C := x; END_TRANSITION\nTRANSITION t3 FROM (B, C) TO A := "
         "x; END_TRANSITION"),
     "step 'B'"},
    {"TwoInitialSteps", "E0720", 4, 14,
     CHART("INITIAL_STEP A: END_STEP\nINITIAL_STEP B: END_STEP\nTRANSITION FROM A TO B := x; END_TRANSITION"),
     "one initial step"},
    {"DurationWithoutQualifier", "E0703", 3, 24, CHART("INITIAL_STEP A: lamp(, T#1s); END_STEP"),
     "takes no duration"},
};

class ChartDiagnostic : public testing::TestWithParam<ChartCase> {};

TEST_P(ChartDiagnostic, Compile_WhenTheChartIsWrong_ThenTheFirstReportHasItsPlace) {
  const ChartCase& expected = GetParam();
  const Diagnostics found = diagnostics_of(std::string(expected.text) + kSub);
  ASSERT_FALSE(found.empty());
  std::size_t at = 0;
  while (at < found.size() && found[at].code != expected.code) ++at;
  ASSERT_LT(at, found.size()) << to_string(found);
  EXPECT_EQ(found[at].where.file, "t.st");
  EXPECT_EQ(found[at].where.line, expected.line) << to_string(found);
  EXPECT_EQ(found[at].where.column, expected.column) << to_string(found);
  EXPECT_THAT(found[at].message + "\n" + found[at].hint, HasSubstr(expected.part));
  for (const auto& each : found) EXPECT_EQ(each.code[0], expected.code[0]) << to_string(found);
}

INSTANTIATE_TEST_SUITE_P(Cases, ChartDiagnostic, testing::ValuesIn(kCases),
                         [](const auto& each) { return each.param.name; });

// SFC-T-1
TEST(ChartText, Compile_WhenEveryFormIsUsed_ThenNothingIsReported) {
  const Diagnostics found = diagnostics_of(
      CHART("{an unknown pragma}\n{SFC_Final_Scan}\n"
            "INITIAL_STEP A: lamp; x(); y(SD, T#1h2m3.5s, lamp); END_STEP;\n"
            "STEP B: work(N, lamp, y); lamp(l, T#5s); END_STEP STEP C: END_STEP\n"
            "TRANSITION t1 (PRIORITY := 1) FROM A TO (B, C) := x AND (n >= 3); END_TRANSITION;\n"
            "TRANSITION (priority := 2) FROM A TO A := B.X OR A.T > T#1s; END_TRANSITION\n"
            "TRANSITION FROM (B, C) TO A := NOT work.A; END_TRANSITION\n"
            "ACTION work: n := n + 1; (* a comment *) IF NOT work.Q THEN n := 0; END_IF; END_ACTION;") +
      std::string(kSub));
  EXPECT_TRUE(found.empty()) << to_string(found);
}

// SFC-T-2
TEST(ChartText, Compile_WhenTheTextIsCutAnywhere_ThenItEndsWithDiagnostics) {
  const std::string text =
      "PROGRAM main VAR x : BOOL; END_VAR {sfc_final_scan} INITIAL_STEP A: x(L, T#5s, x); act(N); END_STEP "
      "TRANSITION t (PRIORITY := 1) FROM A TO (A) := x; END_TRANSITION ACTION act: x := A.X; END_ACTION "
      "END_PROGRAM";
  ASSERT_TRUE(diagnostics_of(text).empty()) << to_string(diagnostics_of(text));
  for (std::size_t length = 14; length + 12 < text.size(); ++length)
    EXPECT_FALSE(diagnostics_of(text.substr(0, length)).empty()) << text.substr(0, length);
}

}  // namespace

// However large or odd a source is, the compiler ends soon: with a container or with a located diagnostic.

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <functional>

#include "ladder/driver/compile.h"
#include "ladder/source/render.h"
#include "tests/support/long_sources.h"
#include "tests/support/sanitized.h"

namespace {

using namespace stepwright;
using namespace stepwright::support;

// Of this process: what else the machine does counts for little.
double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Outcome {
  result::Diagnostics errors;  // empty: it compiled
  double seconds = 0;          // of compiling and of showing the diagnostics
};

Outcome compile(std::string text) {
  driver::CompileInput input;
  input.texts.push_back({"long.st", std::move(text)});
  input.lint = lint::Level::Default;
  Outcome outcome;
  const double start = cpu_seconds();
  auto output = driver::compile(input);
  if (!output) outcome.errors = std::move(output.error());
  for (const result::Diagnostic& each : output ? output->warnings : outcome.errors)
    EXPECT_LT(source::render(each, input.texts, {}).size(), 4000u);
  outcome.seconds = cpu_seconds() - start;
  return outcome;
}

struct Extreme {
  const char* name;
  std::function<std::string()> text;
  const char* code;  // of the diagnostic; null if it compiles
};

void PrintTo(const Extreme& extreme, std::ostream* out) {
  *out << extreme.name;
}

class Extremes : public testing::TestWithParam<Extreme> {};

// A walk over all pairs of what there are 100,000 of would take ten times as long.
TEST_P(Extremes, Compile_WhenTheSourceIsExtreme_ThenEndsSoonWithAContainerOrALocatedDiagnostic) {
  const Outcome outcome = compile(GetParam().text());
  EXPECT_LT(outcome.seconds, support::kSanitized ? 200 : 20);
  if (GetParam().code == nullptr) {
    EXPECT_TRUE(outcome.errors.empty()) << result::to_string(outcome.errors).substr(0, 1000);
    return;
  }
  const auto found =
      std::find_if(outcome.errors.begin(), outcome.errors.end(),
                   [](const result::Diagnostic& each) { return each.code == GetParam().code; });
  ASSERT_NE(found, outcome.errors.end()) << result::to_string(outcome.errors).substr(0, 1000);
  EXPECT_EQ(found->where.file, "long.st");
  EXPECT_GT(found->where.line, 0u);
}

const Extreme kExtremes[] = {
    {"OneLine", [] { return many_rungs_in_a_line(30'000); }, nullptr},
    {"Steps", [] { return many_steps(20'000); }, nullptr},
    {"Alternatives", [] { return many_alternatives(10'000); }, nullptr},
    {"Condition", [] { return long_condition(50'000); }, nullptr},
    {"Selections", [] { return many_selections(40'000); }, nullptr},
    {"Locals65535", [] { return many_locals(65'535); }, nullptr},
    {"Locals65536", [] { return many_locals(65'536); }, "E0209"},
    {"Tasks16", [] { return many_tasks(16); }, nullptr},
    {"Tasks17", [] { return many_tasks(17); }, "E0604"},
    {"BackgroundPrograms8", [] { return many_background_programs(8); }, nullptr},
    {"BackgroundPrograms9", [] { return many_background_programs(9); }, "E0604"},
    {"Arguments1000", [] { return many_arguments(1'000); }, nullptr},
    {"Arguments1001", [] { return many_arguments(1'001); }, "E0403"},
    {"Bounds", [] { return bounded_array("-1073741824", "-1073741816"); }, nullptr},
    {"BoundsBeyond", [] { return bounded_array("-1073741825", "-1073741816"); }, "E0306"},
    {"String65535", [] { return string_of(65'535); }, nullptr},
    {"String65536", [] { return string_of(65'536); }, "E0304"},
    {"Variables", [] { return bounded_array("1", "33554432"); }, nullptr},
    {"VariablesBeyond", [] { return bounded_array("1", "33554433"); }, "E0209"},
    {"Address", [] { return variable_at("%MB65535"); }, nullptr},
    {"AddressBeyond", [] { return variable_at("%MB65536"); }, "E0501"},
    {"FramesOf3Tasks", [] { return large_frames(3); }, nullptr},
    {"FramesOf4Tasks", [] { return large_frames(4); }, "E0209"},
    {"Path", [] { return chart_in_blocks(16); }, nullptr},
    {"LongPath", [] { return chart_in_blocks(17); }, "E0109"},
    {"ArraysInArraysOf140", [] { return nested_arrays(140); }, nullptr},
    {"Callees", [] { return many_callees(30'000); }, nullptr},
    {"Fields", [] { return many_fields(100'000); }, nullptr},
    {"Enumerators", [] { return many_enumerators(100'000); }, nullptr},
    {"CaseRanges", [] { return many_labels(100'000); }, nullptr},
    {"Branches", [] { return many_branches(100'000); }, nullptr},
    {"Constants", [] { return many_constants(100'000); }, nullptr},
    {"FirstValues", [] { return many_elements(300'000); }, nullptr},
    {"RepeatedFirstValues", [] { return repeated_elements(10'000'000); }, nullptr},
    {"UnknownNames", [] { return many_unknown_names(100'000); }, "E0201"},
    {"SyntaxErrors", [] { return many_syntax_errors(100'000); }, "E0104"},
    {"Parentheses", [] { return nested_parentheses(100'000); }, "E0106"},
    {"Negations", [] { return nested_negations(100'000); }, "E0106"},
    {"Ifs", [] { return nested_ifs(100'000); }, "E0106"},
    {"Cases", [] { return nested_cases(100'000); }, "E0106"},
    {"Comments", [] { return nested_comments(10'000); }, nullptr},
    {"OpenComments", [] { return open_comments(500'000); }, "E0102"},
    {"ArraysInArrays", [] { return nested_arrays(100'000); }, "E0106"},
    {"StructuresInStructures", [] { return nested_structures(100'000); }, "E0106"},
    {"TypesOuterFirst", [] { return chained_structures(50'000, false); }, "E0106"},
    {"TypesInnerFirst", [] { return chained_structures(50'000, true); }, "E0106"},
    {"BlocksInBlocks", [] { return chained_blocks(50'000); }, "E0106"},
    {"Calls", [] { return chained_calls(100'000); }, "E0106"},
    {"DoubledBlocks", [] { return doubled_blocks(18); }, nullptr},
    {"Name", [] { return long_name(1'000'000); }, "E0109"},
    {"NameOf255", [] { return long_name(255); }, nullptr},
    {"NameOf256", [] { return long_name(256); }, "E0109"},
    {"NamespacesOf255", [] { return long_namespaces(255); }, nullptr},
    {"NamespacesOf256", [] { return long_namespaces(256); }, "E0109"},
    {"NamespacesOfMany", [] { return long_namespaces(1'000'000); }, "E0109"},
    {"NamespacesInNamespaces", [] { return nested_namespaces(100'000); }, "E0109"},
    {"Namespaces", [] { return many_namespaces(20'000); }, nullptr},
    {"Dimensions", [] { return many_dimensions(100'000); }, "E0106"},
    {"Types", [] { return huge_types(100); }, "E0209"},
};

INSTANTIATE_TEST_SUITE_P(, Extremes, testing::ValuesIn(kExtremes),
                         [](const auto& each) { return std::string(each.param.name); });

struct Growing {
  const char* name;
  std::string (*text)(int count);
  int count;
};

void PrintTo(const Growing& growing, std::ostream* out) {
  *out << growing.name;
}

class Growth : public testing::TestWithParam<Growing> {};

// Eight times as much takes eight times as long, and not 64 times: with room for caches and noise.
TEST_P(Growth, Compile_WhenThereIsEightTimesAsMuch_ThenTheTimeGrowsNoFaster) {
  const auto seconds = [](int count) {
    const std::string text = GetParam().text(count);
    double least = 1e9;
    for (int i = 0; i < 3; ++i) least = std::min(least, compile(text).seconds);
    return least;
  };
  EXPECT_LT(seconds(8 * GetParam().count) / seconds(GetParam().count), 24);
}

const Growing kGrowing[] = {
    {"Rungs", many_rungs, 2000},
    {"OneLine", many_rungs_in_a_line, 2000},
    {"Tags", many_tags, 2000},
    {"Steps", many_steps, 300},
    {"Alternatives", many_alternatives, 250},
    {"Callees", many_callees, 1000},
    {"Fields", many_fields, 2000},
    {"Labels", many_labels, 2000},
    {"Constants", many_constants, 2000},
    {"Enumerators", many_enumerators, 2000},
};

INSTANTIATE_TEST_SUITE_P(, Growth, testing::ValuesIn(kGrowing),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace

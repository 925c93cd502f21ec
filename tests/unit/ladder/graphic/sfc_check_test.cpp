#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "ladder/graphic/sfc_chart.h"
#include "tests/support/sample_charts.h"

namespace stepwright::graphic {
namespace {

using ::testing::HasSubstr;

struct Fault {
  const char* code;
  const char* message;
  std::function<void(SfcChart&)> make;
};

class SfcCheckFault : public ::testing::TestWithParam<Fault> {};

TEST_P(SfcCheckFault, WhenInvariantIsBroken_ThenTheDiagnosticNamesThePlace) {
  SfcChart chart = support::sequence_chart();
  GetParam().make(chart);
  const result::Diagnostics found = check(chart);
  ASSERT_EQ(found.size(), 1U) << result::to_string(found);
  EXPECT_EQ(found[0].code, GetParam().code);
  EXPECT_THAT(found[0].message, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Faults, SfcCheckFault,
    ::testing::Values(
        Fault{"E0710", "no initial step", [](SfcChart& c) { c.steps[0].initial = false; }},
        Fault{"E0711", "step 'a b'", [](SfcChart& c) { c.steps[1].name = "a b"; }},
        Fault{"E0711", "step number 2", [](SfcChart& c) { c.steps[1].name.clear(); }},
        Fault{"E0711", "transition 'IF'", [](SfcChart& c) { c.transitions[1].name = "IF"; }},
        Fault{"E0712", "two steps have the name 's00_start'",
              [](SfcChart& c) { c.steps[1].name = "s00_start"; }},
        Fault{"E0712", "two transitions have the name 'T00'",
              [](SfcChart& c) { c.transitions[1].name = "T00"; }},
        Fault{"E0713", "action block N '' of step 'S01_LOAD'",
              [](SfcChart& c) { c.steps[1].actions[0].target.clear(); }},
        Fault{"E0714", "action block L 'B1' of step 'S01_LOAD'",
              [](SfcChart& c) { c.steps[1].actions[0].qualifier = Qualifier::L; }},
        Fault{"E0715", "duration 'T#1s'", [](SfcChart& c) { c.steps[1].actions[0].duration = "T#1s"; }},
        Fault{"E0716", "transition 'T01' has no source",
              [](SfcChart& c) { c.transitions[1].sources.clear(); }},
        Fault{"E0716", "transition 'T01' has no target",
              [](SfcChart& c) { c.transitions[1].targets.clear(); }},
        Fault{"E0717", "target step number 100",
              [](SfcChart& c) { c.transitions[1].targets[0] = StepId(99); }},
        Fault{"E0718", "transition 'T01' names step 'S02_MOVE' twice",
              [](SfcChart& c) { c.transitions[1].targets.push_back(c.transitions[1].targets[0]); }},
        Fault{"E0719", "compares 'S1' with nothing",
              [](SfcChart& c) { c.transitions[1].condition.operand.clear(); }},
        Fault{"E0719", "transition 'T02' tests nothing",
              [](SfcChart& c) { c.transitions[2].condition.name.clear(); }},
        Fault{"E0720", "step 'S00_START' and step 'S02_MOVE' are both initial",
              [](SfcChart& c) { c.steps[2].initial = true; }}));

TEST(SfcCheck, WhenChartIsSound_ThenNothingIsFound) {
  for (const SfcChart& chart : {support::sequence_chart(), support::nested_chart(),
                                support::partial_order_chart(), support::rich_chart()}) {
    EXPECT_TRUE(check(chart).empty()) << result::to_string(check(chart));
  }
}

TEST(SfcCheck, WhenPartsHaveAPlace_ThenDiagnosticsHaveIt) {
  SfcChart chart = support::sequence_chart();
  chart.transitions[1].where = {"line.st", 12, 3};
  chart.transitions[1].targets.clear();
  const result::Diagnostics found = check(chart);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].where.file, "line.st");
  EXPECT_EQ(found[0].where.line, 12U);
}

TEST(SfcCheck, WhenQualifierIsWritten_ThenItReadsBack) {
  for (int i = 0; i < 11; ++i) {
    const auto qualifier = static_cast<Qualifier>(i);
    EXPECT_EQ(qualifier_from(to_string(qualifier)), qualifier);
  }
  EXPECT_EQ(qualifier_from("sd"), Qualifier::SD);
  EXPECT_EQ(qualifier_from("X"), std::nullopt);
}

}  // namespace
}  // namespace stepwright::graphic

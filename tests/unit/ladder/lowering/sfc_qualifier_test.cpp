// Each qualifier of IEC 61131-3, table 45, on one step: the output in every scan, worked out by hand.

#include <gtest/gtest.h>

#include "ladder/lowering/sfc_to_ladder.h"
#include "tests/support/ladder_evaluator.h"
#include "tests/unit/ladder/lowering/chart_builder.h"

namespace stepwright::lowering {
namespace {

using graphic::ActionBlock;
using graphic::Qualifier;

// Runs a program with scans of 10 ms; `go` is TRUE in the scans named in `pulses` (counted from 1). Returns
// the output `q` of every scan as a text of 0 and 1.
std::string run(const graphic::Pou& pou, const std::string& pulses) {
  const result::Result<graphic::Pou> lowered = lower_sfc(pou);
  if (!lowered) return result::to_string(lowered.error());
  support::LadderEvaluator ladder(*lowered);
  std::string text;
  for (std::size_t scan = 0; scan < pulses.size(); ++scan) {
    ladder.set("go", pulses[scan] == '1');
    ladder.scan(static_cast<std::int64_t>(scan) * 10'000'000);
    text += ladder.get("q") != 0 ? '1' : '0';
  }
  return text;
}

// The step IDLE is initial, RUN carries the block; each TRUE of `go` goes from one to the other.
graphic::Pou one_block(ActionBlock block) {
  graphic::SfcChart chart;
  chart.steps = {step("IDLE", true), step("RUN", false, {std::move(block)})};
  chart.transitions = {transition("T1", {0}, {1}, graphic::contact("go")),
                       transition("T2", {1}, {0}, graphic::contact("go"))};
  return pou_of(chart, {"go", "q"});
}

struct Expectation {
  Qualifier qualifier;
  const char* duration;
  const char* output;
};

class QualifierOnOneStep : public ::testing::TestWithParam<Expectation> {};

// RUN is active in the scans 3 to 7 (0000 0001 ends it at the eighth).
TEST_P(QualifierOnOneStep, WhenStepRunsFiveScans_ThenOutputIsAsInTheStandard) {
  const Expectation& e = GetParam();
  EXPECT_EQ(run(one_block({e.qualifier, "q", e.duration, ""}), "001000010000"), e.output)
      << graphic::to_string(e.qualifier);
}

INSTANTIATE_TEST_SUITE_P(Table45, QualifierOnOneStep,
                         ::testing::Values(Expectation{Qualifier::N, "", "001111100000"},
                                           Expectation{Qualifier::S, "", "001111111111"},
                                           Expectation{Qualifier::R, "", "000000000000"},
                                           Expectation{Qualifier::L, "T#20ms", "001100000000"},
                                           Expectation{Qualifier::L, "T#1s", "001111100000"},
                                           Expectation{Qualifier::D, "T#20ms", "000011100000"},
                                           Expectation{Qualifier::D, "T#1s", "000000000000"},
                                           Expectation{Qualifier::P, "", "001000000000"},
                                           Expectation{Qualifier::P1, "", "001000000000"},
                                           Expectation{Qualifier::P0, "", "000000010000"},
                                           Expectation{Qualifier::SD, "T#70ms", "000000000111"},
                                           Expectation{Qualifier::DS, "T#20ms", "000011111111"},
                                           Expectation{Qualifier::DS, "T#70ms", "000000000000"},
                                           Expectation{Qualifier::SL, "T#70ms", "001111111000"}));

TEST(SfcQualifier, WhenPIsOnInitialStep_ThenItFiresInTheFirstScan) {
  graphic::SfcChart chart;
  chart.steps = {step("A", true, {{Qualifier::P, "q"}}), step("B")};
  chart.transitions = {transition("T1", {0}, {1}, graphic::contact("go"))};
  EXPECT_EQ(run(pou_of(chart, {"go", "q"}), "00010"), "10000");
}

TEST(SfcQualifier, WhenPIsOnTwoStepsInARow_ThenItFiresForBoth) {
  graphic::SfcChart chart;
  chart.steps = {step("A", true), step("B", false, {{Qualifier::P, "q"}}),
                 step("C", false, {{Qualifier::P, "q"}})};
  chart.transitions = {transition("T1", {0}, {1}, graphic::contact("go")),
                       transition("T2", {1}, {2}, graphic::contact("go"))};
  EXPECT_EQ(run(pou_of(chart, {"go", "q"}), "0110000"), "0110000");
  EXPECT_EQ(run(pou_of(chart, {"go", "q"}), "0100100"), "0100100");
}

TEST(SfcQualifier, WhenLIsOnTwoStepsInARow_ThenItsTimeStartsAgain) {
  graphic::SfcChart chart;
  chart.steps = {step("A", true), step("B", false, {{Qualifier::L, "q", "T#20ms", ""}}),
                 step("C", false, {{Qualifier::L, "q", "T#20ms", ""}})};
  chart.transitions = {transition("T1", {0}, {1}, graphic::contact("go")),
                       transition("T2", {1}, {2}, graphic::contact("go"))};
  EXPECT_EQ(run(pou_of(chart, {"go", "q"}), "01001000"), "01101100");
}

TEST(SfcQualifier, WhenAnotherStepResets_ThenStoredActionEnds) {
  graphic::SfcChart chart;
  chart.steps = {step("A", true, {{Qualifier::S, "q"}}), step("B"), step("C", false, {{Qualifier::R, "q"}})};
  chart.transitions = {transition("T1", {0}, {1}, graphic::contact("go")),
                       transition("T2", {1}, {2}, graphic::contact("go"))};
  EXPECT_EQ(run(pou_of(chart, {"go", "q"}), "0101000"), "1110000");
}

TEST(SfcQualifier, WhenResetAndSetAreActiveTogether_ThenResetWins) {
  graphic::SfcChart chart;
  chart.steps = {step("A", true, {{Qualifier::S, "q"}}), step("B", true, {{Qualifier::R, "q"}}),
                 step("C", true, {{Qualifier::N, "q"}})};
  EXPECT_EQ(run(pou_of(chart, {"go", "q"}), "000"), "000");
}

}  // namespace
}  // namespace stepwright::lowering

#include "ladder/lowering/step_timers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ladder/lowering/sfc_to_ladder.h"
#include "tests/support/sfc_reference.h"
#include "tests/unit/ladder/lowering/chart_builder.h"

namespace stepwright::lowering {
namespace {

using graphic::all;
using graphic::any;
using graphic::compare;
using graphic::CompareOp;
using graphic::contact;

// A -> B after 50 ms and `go`; A -> C after 200 ms or `stop`.
graphic::Pou waiting() {
  graphic::SfcChart chart;
  chart.steps = {step("A", true), step("B"), step("C")};
  chart.transitions = {
      transition("T1", {0}, {1}, all({compare("A.T", CompareOp::GreaterEqual, "T#50ms"), contact("go")})),
      transition("T2", {0}, {2}, any({compare("A.T", CompareOp::GreaterEqual, "T#200ms"), contact("stop")})),
      transition("T3", {1}, {0}, compare("A.T", CompareOp::GreaterEqual, "T#1s")),
  };
  return pou_of(std::move(chart), {"go", "stop"});
}

const graphic::SfcChart& chart_of(const graphic::Pou& pou) {
  return std::get<graphic::SfcChart>(pou.body);
}

// The scan (10 ms each) in which `step` becomes active; -1 if it does not within 100 scans.
int scan_of(const graphic::Pou& pou, std::size_t step, bool go) {
  support::SfcReference reference(chart_of(pou));
  const auto input = [&](const std::string& name) -> std::int64_t {
    if (name == "go") return go;
    return name == "stop" ? 0 : reference.action(name);
  };
  for (int scan = 0; scan < 100; ++scan) {
    reference.scan(scan * 10'000'000LL, input);
    if (reference.active(step)) return scan;
  }
  return -1;
}

TEST(WithStepTimers, WhenTransitionsWait_ThenTimesBecomeDelayedFlags) {
  const graphic::Pou timed = with_step_timers(waiting());
  const auto& chart = chart_of(timed);
  ASSERT_EQ(chart.steps[0].actions.size(), 2U);
  EXPECT_EQ(chart.steps[0].actions[0].qualifier, graphic::Qualifier::D);
  EXPECT_EQ(chart.steps[0].actions[0].duration, "T#50ms");
  EXPECT_EQ(to_st(chart.transitions[0].condition), "A_DUE AND go");
  EXPECT_EQ(to_st(chart.transitions[1].condition), "A_DUE_2 OR stop");
  // The time of a step that the transition does not leave keeps its value: no timer can stand for it.
  EXPECT_EQ(chart.transitions[2].condition, chart_of(waiting()).transitions[2].condition);
}

TEST(WithStepTimers, WhenPlayed_ThenTransitionsFireOneScanLater) {
  const graphic::Pou timed = with_step_timers(waiting());
  EXPECT_EQ(scan_of(waiting(), 1, true), 5);
  EXPECT_EQ(scan_of(timed, 1, true), 6);
  EXPECT_EQ(scan_of(waiting(), 2, false), 20);
  EXPECT_EQ(scan_of(timed, 2, false), 21);
}

TEST(WithStepTimers, WhenLowered_ThenNoTimeVariableIsLeft) {
  graphic::Pou pou = waiting();
  std::get<graphic::SfcChart>(pou.body).transitions.pop_back();
  const auto has_time = [](const graphic::Pou& ladder) {
    return std::any_of(ladder.variables.begin(), ladder.variables.end(),
                       [](const graphic::Variable& v) { return v.type == "TIME"; });
  };
  const auto plain = lower_sfc(pou);
  const auto timed = lower_sfc(with_step_timers(pou));
  ASSERT_TRUE(plain && timed);
  EXPECT_TRUE(has_time(*plain));
  EXPECT_FALSE(has_time(*timed));
}

}  // namespace
}  // namespace stepwright::lowering

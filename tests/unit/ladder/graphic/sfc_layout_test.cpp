// Properties of the layout of any chart.

#include "ladder/graphic/sfc_layout.h"

#include <gtest/gtest.h>

#include "tests/support/sample_charts.h"
#include "tests/unit/ladder/lowering/random_chart.h"

namespace stepwright::graphic {
namespace {

constexpr SfcMetrics metrics{.margin = 5,
                             .character = 7,
                             .small_character = 6,
                             .line = 15,
                             .min_step_width = 50,
                             .action_gap = 10,
                             .action_row = 18,
                             .bar = 10,
                             .node_gap = 20,
                             .channel_padding = 8,
                             .track = 8,
                             .overhang = 6,
                             .arrow = 12};

struct Box {
  int left, top, right, bottom;
};

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

std::vector<Box> boxes_of(const SfcLayout& layout) {
  std::vector<Box> boxes;
  for (const PlacedStep& s : layout.steps) {
    int right = s.x + s.width;
    if (!s.actions.empty()) right = s.actions_x + s.qualifier_width + s.target_width;
    boxes.push_back({s.x, s.y, right, s.y + s.height});
  }
  for (const PlacedTransition& t : layout.transitions) {
    boxes.push_back({t.axis - metrics.bar, t.y - 1, t.axis + metrics.bar, t.y + 1});
  }
  return boxes;
}

// A line runs through a box if it has a point strictly inside of it.
bool cuts(const PlacedLine& line, const Box& box) {
  return overlap({line.x1, line.y1, line.x2 + 1, line.y2 + 1},
                 {box.left + 1, box.top + 1, box.right - 1, box.bottom - 1});
}

void expect_sound(const SfcChart& chart) {
  const SfcLayout layout = lay_out(chart, metrics);
  ASSERT_EQ(layout.steps.size(), chart.steps.size());
  ASSERT_EQ(layout.transitions.size(), chart.transitions.size());
  const std::vector<Box> boxes = boxes_of(layout);
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    EXPECT_GE(boxes[a].left, 0);
    EXPECT_LE(boxes[a].right, layout.width);
    EXPECT_LE(boxes[a].bottom, layout.height);
    for (std::size_t b = a + 1; b < boxes.size(); ++b) EXPECT_FALSE(overlap(boxes[a], boxes[b]));
  }
  for (const PlacedLine& line : layout.lines) {
    EXPECT_TRUE(line.x1 == line.x2 || line.y1 == line.y2);
    for (std::size_t i = 0; i < layout.steps.size(); ++i) EXPECT_FALSE(cuts(line, boxes[i]));
  }
}

TEST(SfcLayout, WhenChartIsRandom_ThenNothingOverlapsAndNoLineCutsAStep) {
  for (unsigned seed = 1; seed <= 400 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    expect_sound(std::get<SfcChart>(lowering::random_pou(random).body));
  }
}

TEST(SfcLayout, WhenChartIsASequence_ThenItIsOneStraightLine) {
  const SfcChart chart = support::sequence_chart();
  const SfcLayout layout = lay_out(chart, metrics);
  for (const PlacedStep& step : layout.steps) EXPECT_EQ(step.axis, layout.steps[0].axis);
  ASSERT_EQ(layout.jumps.size(), 1U);
  EXPECT_EQ(layout.jumps[0].target, StepId(0));
  EXPECT_EQ(layout.steps[0].jumps, "T04");
}

TEST(SfcLayout, WhenSimultaneousBranchesDoNotNest_ThenEveryBranchHasItsDoubleLines) {
  const SfcChart chart = support::partial_order_chart();
  const SfcLayout layout = lay_out(chart, metrics);
  int doubled = 0;
  for (const PlacedLine& line : layout.lines) doubled += line.doubled ? 1 : 0;
  EXPECT_EQ(doubled, 5);  // three divergences, two convergences
  EXPECT_TRUE(layout.jumps.empty());
  for (const Transition& transition : chart.transitions) {
    for (const StepId source : transition.sources) {
      for (const StepId target : transition.targets) {
        EXPECT_LT(layout.steps[source.value].y, layout.steps[target.value].y);
      }
    }
  }
}

TEST(SfcLayout, WhenConditionIsLong_ThenItIsWrappedBeforeOperators) {
  EXPECT_EQ(wrap_condition("aaaa AND bbbb OR cccc", 10),
            (std::vector<std::string>{"aaaa", "AND bbbb", "OR cccc"}));
  EXPECT_EQ(wrap_condition("aaaa AND bbbb", 40), (std::vector<std::string>{"aaaa AND bbbb"}));
  EXPECT_EQ(wrap_condition("", 40), (std::vector<std::string>{""}));
}

}  // namespace
}  // namespace stepwright::graphic

#include "ladder/graphic/sfc_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <set>

#include "ladder/graphic/text_canvas.h"
#include "tests/support/sample_charts.h"

namespace stepwright::graphic {
namespace {

using ::testing::HasSubstr;

TEST(SfcDrawing, WhenChartIsDrawnAsSvg_ThenEveryStepAndTransitionIsAGroup) {
  for (const SfcChart& chart : {support::sequence_chart(), support::nested_chart(),
                                support::partial_order_chart(), support::rich_chart()}) {
    const result::Result<std::string> svg = draw_sfc_svg(chart);
    ASSERT_TRUE(svg);
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg->c_str())) << *svg;
    EXPECT_NE(document.child("svg").attribute("viewBox").as_string()[0], '\0');
    std::set<std::string> steps;
    for (const pugi::xml_node group : document.child("svg").children("g")) {
      if (group.attribute("data-step")) steps.insert(group.attribute("data-step").as_string());
    }
    EXPECT_EQ(steps.size(), chart.steps.size());
    for (const Step& step : chart.steps) EXPECT_EQ(steps.count(step.name), 1U) << step.name;
    EXPECT_EQ(*svg, *draw_sfc_svg(chart));
  }
}

TEST(SfcDrawing, WhenTextHoldsMarkup_ThenItIsEscaped) {
  SfcChart chart = support::sequence_chart();
  chart.steps[1].comment = "<script>alert('&')</script>\x01";
  const result::Result<std::string> svg = draw_sfc_svg(chart);
  ASSERT_TRUE(svg);
  EXPECT_EQ(svg->find("<script>"), std::string::npos);
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(svg->c_str()));
}

TEST(SfcDrawing, WhenChartIsUnsound_ThenItsErrorsAreReturned) {
  SfcChart chart = support::sequence_chart();
  chart.transitions[0].targets[0] = StepId(77);
  ASSERT_FALSE(draw_sfc_svg(chart));
  const result::Result<std::string> text = draw_sfc_text(chart);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error()[0].code, "E0717");
}

TEST(SfcDrawing, WhenBranchesAreSimultaneousAndAlternative_ThenTextShowsDoubleAndSingleLines) {
  SfcChart chart;
  chart.steps.resize(3);
  chart.steps[0].name = "A";
  chart.steps[0].initial = true;
  chart.steps[1].name = "B";
  chart.steps[1].actions = {{Qualifier::N, "q"}};
  chart.steps[2].name = "C";
  chart.transitions.resize(2);
  chart.transitions[0] = {"T1", {StepId(0)}, {StepId(1), StepId(2)}, contact("x"), 0, "", {}};
  chart.transitions[1] = {"T2", {StepId(1), StepId(2)}, {StepId(0)}, always(), 0, "", {}};
  const result::Result<std::string> text = draw_sfc_text(chart);
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("╔══╧══╗"));
  EXPECT_THAT(*text, HasSubstr("━━╋━━ x"));
  EXPECT_THAT(*text, HasSubstr("───[N q]"));
  EXPECT_THAT(*text, HasSubstr("═╤═"));
  EXPECT_THAT(*text, HasSubstr("═╧═"));
  EXPECT_THAT(*text, HasSubstr("▼ A"));
}

TEST(TextCanvas, WhenLinesMeet_ThenTheyJoinAndWhenTheyPassTheyDoNot) {
  TextCanvas canvas;
  canvas.horizontal(0, 4, 1);
  canvas.vertical(1, 1, 2);  // hangs below
  canvas.vertical(3, 0, 2);  // passes
  canvas.horizontal(6, 8, 1, true);
  canvas.vertical(7, 0, 1);
  EXPECT_EQ(canvas.finish(), "   │   │\n─┬─│─ ═╧═\n │ │\n");
}

}  // namespace
}  // namespace stepwright::graphic

#include "supervisor/translate/plan_svg.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/translate/bench_run.h"

namespace stepwright::translate {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(PlanSvg, WhenDrawn_ThenEveryActionHasABarAndABoxAndEveryLinkAnArrow) {
  const auto run = testing::bench_run(testing::metric_ff_plan());
  const auto made = schedule(run, testing::bench_binding(), false);
  ASSERT_TRUE(made);
  const std::string svg = plan_svg(run, *made);
  EXPECT_EQ(count(svg, "class=\"bar"), run.actions.size());
  EXPECT_EQ(count(svg, "class=\"box"), run.actions.size());
  EXPECT_EQ(count(svg, "<path class="), made->links.size());
  EXPECT_GT(count(svg, " critical\""), 0u);
  EXPECT_LT(count(svg, " critical\""), run.actions.size());
  EXPECT_NE(svg.find("(load v1 f1 level8)"), std::string::npos);
  EXPECT_NE(svg.find("causal: (level a1)"), std::string::npos);
  EXPECT_EQ(count(svg, "<svg"), count(svg, "</svg>"));
}

TEST(PlanSvg, WhenThereIsNoBinding_ThenActionsTakeOneStepEach) {
  const auto run = testing::bench_run({"(load v1 f1 level8)", "(move v1 f1 a1)"});
  const Schedule made = unit_schedule(run);
  EXPECT_EQ(made.makespan_s, 2.0);
  EXPECT_EQ(made.actions[1].start_s, 1.0);
  EXPECT_NE(plan_svg(run, made, "steps").find("Schedule: 2.0 steps"), std::string::npos);
}

TEST(PlanSvg, WhenThePlanIsEmpty_ThenThePictureIsToo) {
  const std::string svg = plan_svg({}, unit_schedule({}));
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(count(svg, "class=\"bar"), 0u);
}

}  // namespace
}  // namespace stepwright::translate

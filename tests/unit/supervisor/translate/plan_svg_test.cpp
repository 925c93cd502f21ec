#include "supervisor/translate/plan_svg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

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

// The numbers that follow `before` in the elements that begin with `element`.
std::vector<double> numbers(const std::string& svg, const std::string& element, const std::string& before) {
  std::vector<double> found;
  for (std::size_t at = svg.find(element); at != std::string::npos; at = svg.find(element, at + 1)) {
    found.push_back(std::stod(svg.substr(svg.find(before, at) + before.size())));
  }
  return found;
}

TEST(PlanSvg, WhenThePlanIsLong_ThenItsGraphIsAsWideAsItsScheduleAndNoBoxesMeet) {
  std::vector<std::string> actions;
  for (int i = 0; i < 25; ++i) {
    for (const char* action :
         {"(load v1 f1 level8)", "(move v1 f1 a1)", "(unload v1 a1 level8)", "(move v1 a1 f1)"})
      actions.emplace_back(action);
  }
  const auto run = testing::bench_run(actions);
  const std::string svg = plan_svg(run, unit_schedule(run), "steps");
  const double width = numbers(svg, "<svg ", "width=\"").front();
  const double height = numbers(svg, "<svg ", "height=\"").front();
  EXPECT_LT(width, 1000.0);
  const auto x = numbers(svg, "class=\"box", " x=\"");
  const auto y = numbers(svg, "class=\"box", " y=\"");
  const double wide = numbers(svg, "class=\"box", " width=\"").front();
  ASSERT_EQ(x.size(), actions.size());
  std::set<std::pair<double, double>> places;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_LE(x[i] + wide, width);
    EXPECT_LE(y[i] + 34.0, height);
    places.emplace(x[i], y[i]);
  }
  EXPECT_EQ(places.size(), x.size());
  EXPECT_GT(*std::max_element(y.begin(), y.end()), y.front() + 500.0);
}

TEST(PlanSvg, WhenNamesAreLong_ThenTheyAreCutAndTheWholeOneIsInTheTitle) {
  auto run = testing::bench_run({"(load v1 f1 level8)"});
  run.actions[0].action.arguments = {std::string(200, 'v'), "f1", "level8"};
  const std::string svg = plan_svg(run, unit_schedule(run), "steps");
  EXPECT_LT(numbers(svg, "<svg ", "width=\"").front(), 1300.0);
  EXPECT_NE(svg.find("…</text>"), std::string::npos);
  EXPECT_NE(svg.find("(load " + std::string(200, 'v') + " f1 level8)</title>"), std::string::npos);
}

TEST(PlanSvg, WhenThePlanIsEmpty_ThenThePictureIsToo) {
  const std::string svg = plan_svg({}, unit_schedule({}));
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(count(svg, "class=\"bar"), 0u);
}

}  // namespace
}  // namespace stepwright::translate

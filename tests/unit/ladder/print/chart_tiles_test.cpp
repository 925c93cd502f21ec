#include "ladder/print/chart_tiles.h"

#include <gtest/gtest.h>

#include "ladder/print/cuts.h"
#include "tests/support/sample_charts.h"

namespace stepwright::print {
namespace {

TEST(Cuts, WhenThingsFit_ThenCutsGoBetweenThem) {
  const auto found = cuts({{0, 10}, {20, 30}, {40, 50}, {45, 60}}, 60, 35);
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, (std::vector<int>{0, 35, 60}));
}

TEST(Cuts, WhenOneThingIsTooLong_ThenThereAreNone) {
  EXPECT_FALSE(cuts({{0, 10}, {20, 90}}, 100, 50));
}

graphic::SfcChart long_chart(std::uint32_t steps) {
  graphic::SfcChart chart;
  for (std::uint32_t i = 0; i < steps; ++i) {
    graphic::Step& step = chart.steps.emplace_back();
    step.name = "S" + std::to_string(i);
    step.initial = i == 0;
    graphic::Transition& transition = chart.transitions.emplace_back();
    transition.name = "T" + std::to_string(i);
    transition.sources = {graphic::StepId(i)};
    transition.targets = {graphic::StepId((i + 1) % steps)};
  }
  return chart;
}

TEST(ChartTiles, WhenChartIsLong_ThenTilesCoverItWithoutGapsAndFit) {
  const graphic::SfcChart chart = long_chart(60);
  const ChartTiles tiles(chart, 650, 900);
  ASSERT_GT(tiles.tiles().size(), 2U);
  for (std::size_t i = 0; i < tiles.tiles().size(); ++i) {
    EXPECT_LE(tiles.height_of(i), 900);
    EXPECT_EQ(tiles.tiles()[i].y1, i > 0 ? tiles.tiles()[i - 1].y2 : 0);
  }
}

TEST(ChartTiles, WhenChartIsCut_ThenBothEndsReferToEachOther) {
  const graphic::SfcChart chart = long_chart(30);
  ChartTiles tiles(chart, 650, 900);
  for (std::size_t i = 0; i < tiles.tiles().size(); ++i) tiles.set_page(i, i + 5);
  graphic::SvgWriter first(100, 100, "", "");
  tiles.draw(first, 0, 0, 0);
  const std::string one = first.finish();
  EXPECT_NE(one.find(">/6.1<"), std::string::npos) << one;
  graphic::SvgWriter second(100, 100, "", "");
  tiles.draw(second, 1, 0, 0);
  EXPECT_NE(second.finish().find(">/5.1<"), std::string::npos);
  // The jump back to the first step names the page of its transition, and the transition that of the step.
  const std::size_t last = tiles.tiles().size() - 1;
  EXPECT_NE(one.find(">T29 /" + std::to_string(last + 5) + "<"), std::string::npos) << one;
  graphic::SvgWriter end(100, 100, "", "");
  tiles.draw(end, last, 0, 0);
  EXPECT_NE(end.finish().find(">S0 /5<"), std::string::npos);
}

TEST(ChartTiles, WhenPageIsTiny_ThenChartStillFits) {
  for (const graphic::SfcChart& chart : {support::nested_chart(), support::rich_chart()}) {
    const ChartTiles tiles(chart, 60, 60);
    for (std::size_t i = 0; i < tiles.tiles().size(); ++i) EXPECT_LE(tiles.height_of(i), 61);
  }
}

}  // namespace
}  // namespace stepwright::print

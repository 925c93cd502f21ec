#include "hmi_web/monitor/chart_picture.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

namespace stepwright::monitor {
namespace {

using nlohmann::json;

// "First": a loop of a step with two exits beside it; "Second": simultaneous branches.
protocol::Program two_charts() {
  protocol::Program program;
  program.charts = {{"First", 4, 4}, {"Second", 4, 2}};
  program.steps = {{"START", "", true}, {"FILL", "(fill)", false}, {"LATE", "", false},  {"HIGH", "", false},
                   {"BEGIN", "", true}, {"LEFT", "", false},       {"RIGHT", "", false}, {"END", "", false}};
  program.transitions = {{"t0", {0}, {1}, "go"},
                         {"t1", {1}, {0}, "level > 5"},
                         {"t2", {1}, {2}, "FILL_T >= T#10s AND NOT level_is_reached"},
                         {"t3", {1}, {3}, "too_high"},
                         {"t4", {4}, {5, 6}, "TRUE"},
                         {"t5", {5, 6}, {7}, "TRUE"}};
  return program;
}

std::vector<int> indices(const json& parts) {
  std::vector<int> list;
  for (const json& each : parts) list.push_back(each["index"].get<int>());
  return list;
}

TEST(ChartPicture, WhenNobodyAsksForExits_ThenThoseThatAreActiveAreDrawnOnly) {
  const json picture = chart_picture(two_charts(), "first", {});
  EXPECT_EQ(picture["exits"], json({2, 3}));
  EXPECT_EQ(indices(picture["steps"]), (std::vector{0, 1}));
  EXPECT_EQ(indices(picture["transitions"]), (std::vector{0, 1}));
  const json late = chart_picture(two_charts(), "First", {false, {2}});
  EXPECT_EQ(indices(late["steps"]), (std::vector{0, 1, 2}));
  EXPECT_EQ(indices(late["transitions"]), (std::vector{0, 1, 2}));
  EXPECT_EQ(indices(chart_picture(two_charts(), "First", {true, {}})["steps"]), (std::vector{0, 1, 2, 3}));
}

TEST(ChartPicture, WhenATransitionLeadsBack_ThenAnArrowNamesItsStepAndEntersAboveIt) {
  const json picture = chart_picture(two_charts(), "First", {});
  ASSERT_EQ(picture["jumps"].size(), 1u);
  EXPECT_EQ(picture["jumps"][0]["step"], 0);
  EXPECT_TRUE(picture["steps"][0]["entry"].is_number());
  EXPECT_TRUE(picture["steps"][1]["entry"].is_null());
}

TEST(ChartPicture, WhenOneChartIsAskedFor_ThenItsPartsCountFromItsFirst) {
  const json picture = chart_picture(two_charts(), "Second", {});
  EXPECT_EQ(indices(picture["steps"]), (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(picture["doubles"].size(), 2u) << "where simultaneous branches begin and end";
  EXPECT_TRUE(chart_picture(two_charts(), "Third", {}).is_null());
}

TEST(ChartPicture, WhenAllAreDrawnTogether_ThenNothingOverlapsAndNothingSticksOut) {
  const json picture = chart_picture(two_charts(), "", {true, {}});
  const json& steps = picture["steps"];
  ASSERT_EQ(steps.size(), 8u);
  for (const json& one : steps) {
    EXPECT_GE(one["x"].get<int>(), 0);
    EXPECT_LE(one["x"].get<int>() + one["width"].get<int>(), picture["width"].get<int>());
    EXPECT_LE(one["y"].get<int>() + one["height"].get<int>(), picture["height"].get<int>());
    for (const json& other : steps) {
      if (one == other || one["y"] != other["y"]) continue;
      EXPECT_GE(std::abs(one["x"].get<int>() - other["x"].get<int>()), one["width"].get<int>());
    }
  }
}

TEST(ChartPicture, WhenTextsAreLong_ThenTheyAreCutToWhatTheirPlaceHolds) {
  const json picture = chart_picture(two_charts(), "First", {true, {}});
  EXPECT_EQ(picture["transitions"][2]["label"], "FILL_T >= T#10s AND N\xE2\x80\xA6");
  for (const json& step : picture["steps"]) EXPECT_EQ(step["height"], picture["steps"][0]["height"]);
}

TEST(ChartPicture, WhenThereIsNoChart_ThenThePictureIsEmpty) {
  const json picture = chart_picture({}, "", {});
  EXPECT_TRUE(picture["steps"].empty() && picture["lines"].empty());
}

}  // namespace
}  // namespace stepwright::monitor

#include "hmi_web/protocol/live_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace stepwright::protocol {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class LiveStateTest : public testing::Test {
 protected:
  LiveStateTest() {
    state_.runtime_alive = true;
    state_.runtime_state = "running";
    state_.program_digest = "ab12";
    state_.scan = 7;
    state_.figures.p50_us = 3.5;
    state_.active_steps = {0};
    state_.points = {1.0, std::nullopt, 20.25};
    state_.tags = {0.0, 1.0, 2.0, 3.0, 4.0};
    live_.take(state_, 1, true);
  }
  json whole(TagChoice tags = TagChoice::everything()) const { return told({0, std::move(tags), {}}); }
  json since(std::uint64_t sequence, TagChoice tags = TagChoice::everything()) const {
    return told({sequence, std::move(tags), {}});
  }
  json told(const StateRequest& request) const { return json::parse(live_.message(request)); }
  static TagChoice only(std::vector<TagRange> ranges) { return {false, "", std::move(ranges)}; }

  CellState state_;
  LiveState live_;
};

TEST_F(LiveStateTest, WhenNothingIsThereYet_ThenTheWholeStateComes) {
  const json message = whole();

  EXPECT_EQ(message["type"], "state");
  EXPECT_EQ(message["seq"], 1);
  EXPECT_EQ(message["points"], json({1, nullptr, 20.25}));
  EXPECT_EQ(message["figures"]["p50_us"], 3.5);
  EXPECT_EQ(message["steps"], json({0}));
  EXPECT_EQ(message["tags"], json({{"0", 0}, {"1", 1}, {"2", 2}, {"3", 3}, {"4", 4}}));
  EXPECT_FALSE(message.contains("show"));
}

TEST_F(LiveStateTest, WhenATagIsATime_ThenItsNanosecondsAreTold) {
  state_.tags = {0.0, 0.000004, 2.0, 0.0040005, 4.0};
  live_.take(state_, 2, true);
  EXPECT_EQ(whole()["tags"], json({{"0", 0}, {"1", 0.000004}, {"2", 2}, {"3", 0.0040005}, {"4", 4}}));
}

TEST_F(LiveStateTest, WhenATagIsARealOrAnLreal_ThenItIsToldWithTheFewestDigitsThatMeanIt) {
  state_.reals = {0, 1, 4};
  state_.tags = {0.00123F, 4e-5F, 1.23456789, static_cast<double>(0.1F), 0.1F};
  live_.take(state_, 2, true);
  EXPECT_THAT(live_.message({0, TagChoice::everything(), {}}),
              HasSubstr(R"("tags":{"0":0.00123,"1":4e-05,"2":1.23456789,"3":0.10000000149011612,"4":0.1})"));
  state_.tags = {1e6F, 16777216.0F, 1e300, 12345678.5, 3.4028235e38F};
  live_.take(state_, 3, false);
  EXPECT_THAT(live_.message({2, TagChoice::everything(), {}}),
              HasSubstr(R"("tags":{"0":1000000,"1":16777216,"2":1e+300,"3":12345678.5,"4":3.4028235e+38})"));
}

TEST_F(LiveStateTest, WhenAPointIsSmall_ThenItHasSixDigits) {
  state_.points = {0.00123456789, 4e-5, 1234.56789};
  live_.take(state_, 2, false);
  EXPECT_EQ(whole()["points"], json({0.00123457, 0.00004, 1234.568}));
}

TEST_F(LiveStateTest, WhenTagsHaveTexts_ThenTheyTravelAsTextWheneverTheyChange) {
  state_.tags = {0.0, std::nullopt, 2.0, std::nullopt, 4.0};
  state_.texts = {{1, "said \"so\""}, {3, ""}};
  live_.take(state_, 2, true);
  EXPECT_EQ(whole()["tags"], json({{"0", 0}, {"1", "said \"so\""}, {"2", 2}, {"3", ""}, {"4", 4}}));
  live_.take(state_, 3, false);
  EXPECT_FALSE(since(2).contains("tags"));
  state_.texts[3] = "now";
  live_.take(state_, 4, false);
  EXPECT_EQ(since(2)["tags"], json({{"3", "now"}}));
  state_.texts.clear();
  live_.take(state_, 5, false);
  EXPECT_EQ(since(4)["tags"], json({{"1", nullptr}, {"3", nullptr}})) << "it is not known any more";
}

TEST_F(LiveStateTest, WhenADeviceDoesNotAnswer_ThenItsTagsAreToldAsRangesWheneverThatChanges) {
  EXPECT_EQ(whole()["unread"], json::array());
  state_.unread = {{"tank", Unread::Lost, {0, 1, 3}}, {"drive", Unread::Never, {}}};
  live_.take(state_, 2, false);
  const json tank = {{"device", "tank"}, {"why", "lost"}, {"tags", {{0, 2}, {3, 1}}}};
  const json drive = {{"device", "drive"}, {"why", "never"}, {"tags", json::array()}};
  EXPECT_EQ(since(1)["unread"], (json{tank, drive}));
  EXPECT_FALSE(since(1).contains("tags")) << "their values have not changed";
  live_.take(state_, 3, false);
  EXPECT_FALSE(since(2).contains("unread"));
  state_.unread = {{"tank", Unread::Untold, {0}}};
  live_.take(state_, 4, false);
  EXPECT_EQ(since(3)["unread"][0]["why"], "untold");
  state_.unread.clear();
  live_.take(state_, 5, false);
  EXPECT_EQ(since(4)["unread"], json::array());
}

TEST_F(LiveStateTest, WhenNumbersAreNotFinite_ThenTheyAreNull) {
  state_.points = {std::nan(""), std::numeric_limits<double>::infinity(), 1e300};
  live_.take(state_, 2, false);

  const json message = whole();
  EXPECT_TRUE(message["points"][0].is_null());
  EXPECT_TRUE(message["points"][1].is_null());
  EXPECT_EQ(message["points"][2], 1e300);
}

TEST_F(LiveStateTest, WhenTextIsNotUtf8_ThenItIsRepaired) {
  state_.runtime_detail = "broken \xff\xfe text";
  live_.take(state_, 2, false);

  EXPECT_NE(whole()["runtime_detail"].get<std::string>().find("broken"), std::string::npos);
}

TEST_F(LiveStateTest, WhenOneValueChanges_ThenOnlyThatOneIsInTheDelta) {
  state_.scan = 8;
  state_.points[1] = 4.5;
  live_.take(state_, 4, false);

  EXPECT_EQ(since(1), json({{"type", "delta"}, {"seq", 4}, {"scan", 8}, {"points", {{"1", 4.5}}}}));
}

TEST_F(LiveStateTest, WhenAValueBecomesUnknown_ThenItIsNull) {
  state_.tags[1] = std::nullopt;
  live_.take(state_, 2, false);

  EXPECT_EQ(since(1)["tags"], json({{"1", nullptr}}));
}

TEST_F(LiveStateTest, WhenAValueTremblesBehindTheThirdDecimal_ThenItIsNoChange) {
  state_.points[2] = 20.25 + 1e-5;
  live_.take(state_, 2, false);

  EXPECT_EQ(since(1), json({{"type", "delta"}, {"seq", 2}}));
}

TEST_F(LiveStateTest, WhenMessagesWereMissed_ThenTheDeltaHasAllThatChangedSince) {
  state_.tags[0] = 10.0;
  live_.take(state_, 2, false);
  state_.tags[1] = 11.0;
  live_.take(state_, 3, false);
  state_.tags[1] = 12.0;
  live_.take(state_, 4, false);

  EXPECT_EQ(since(1)["tags"], json({{"0", 10}, {"1", 12}}));
  EXPECT_EQ(since(2)["tags"], json({{"1", 12}}));
  EXPECT_FALSE(since(4).contains("tags"));
}

TEST_F(LiveStateTest, WhenSomeTagsAreChosen_ThenTheOthersAreLeftOut) {
  for (auto& tag : state_.tags) *tag += 10;
  live_.take(state_, 2, false);

  EXPECT_EQ(since(1, only({{1, 1}, {3, 2}}))["tags"], json({{"1", 11}, {"3", 13}, {"4", 14}}));
  EXPECT_EQ(whole(only({{0, 2}}))["tags"], json({{"0", 10}, {"1", 11}}));
  EXPECT_EQ(whole(only({}))["tags"], json::object());
  EXPECT_FALSE(since(1, only({})).contains("tags"));
}

TEST_F(LiveStateTest, WhenRangesReachBehindTheEnd_ThenTheyEndThere) {
  EXPECT_EQ(whole(only({{4, 4'000'000'000}}))["tags"], json({{"4", 4}}));
  EXPECT_EQ(whole(only({{4'294'967'294, 1}}))["tags"], json::object());
}

TEST_F(LiveStateTest, WhenAChoiceIsAnswered_ThenAllItsTagsComeThoughNoneHasChanged) {
  const json message = told({1, only({{2, 2}}), 9});

  EXPECT_EQ(message, json({{"type", "delta"}, {"seq", 1}, {"show", 9}, {"tags", {{"2", 2}, {"3", 3}}}}));
  EXPECT_EQ(told({1, only({}), 10})["tags"], json::object());
}

TEST_F(LiveStateTest, WhenAnotherProgramRuns_ThenItsTagsAreNew) {
  state_.tags = {0.0, 7.0};
  live_.take(state_, 2, true);

  EXPECT_EQ(since(1)["tags"], json({{"0", 0}, {"1", 7}}));
}

}  // namespace
}  // namespace stepwright::protocol

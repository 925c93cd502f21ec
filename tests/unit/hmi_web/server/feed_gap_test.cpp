#include "hmi_web/server/feed.h"

#include <nlohmann/json.hpp>

#include "tests/unit/hmi_web/server/feed_fixture.h"

namespace stepwright::server {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

class Gap : public ChosenTags {
 protected:
  // The same page on another connection.
  Feed::Cursor back(const std::string& has,
                    const std::string& tags = R"("digest":"ab","tags":[[0,2]])") const {
    return viewer(begin(tags, has));
  }
  static std::string has(const json& state, const json& trend, bool tags) {
    return R"("program":1,"seq":)" + state["seq"].dump() + R"(,"tags":)" + (tags ? "true" : "false") +
           R"(,"trend_run":)" + trend["run"].dump() + R"(,"trend_next":)" +
           std::to_string(trend["first"].get<std::size_t>() + trend["rows"].size());
  }
};

TEST_F(Gap, WhenAPageComesBack_ThenItGetsOnlyWhatItMissed) {
  Feed::Cursor cursor = viewer(begin(R"("digest":"ab","tags":[[0,2]])"));
  const auto before = drain(cursor);
  view_.state.points[1] = 0.0;
  view_.state.tags[1] = 77.0;
  for (int i = 0; i < 4; ++i) {
    view_.state.time_s += 1;
    now_ += 100ms;
    update();
  }

  Feed::Cursor again = back(has(before[2], before[3], true));
  const auto messages = drain(again);
  ASSERT_EQ(types(messages), (Types{"hello", "delta", "trend", "trend"}));
  EXPECT_EQ(messages[1]["points"], json({{"1", 0}}));
  EXPECT_EQ(messages[1]["tags"], json({{"1", 77}}));
  EXPECT_FALSE(messages[1].contains("show"));
  EXPECT_EQ(messages[2]["restart"], false);
  EXPECT_EQ(messages[2]["first"], 1);
  EXPECT_EQ(messages[2]["rows"][0][0], 1);
  EXPECT_EQ(messages[3]["rows"][0][0], 4);
}

TEST_F(Gap, WhenThePageWantsOtherTagsThanItHas_ThenTheyComeWhole) {
  Feed::Cursor cursor = viewer(begin(R"("digest":"ab","tags":[[0,2]])"));
  const auto before = drain(cursor);
  Feed::Cursor again = back(has(before[2], before[3], false));
  const json delta = newest(again);
  EXPECT_EQ(delta["show"], 1);
  EXPECT_EQ(delta["tags"], json({{"0", 0}, {"1", 1}}));
}

TEST_F(Gap, WhenNothingWasMissed_ThenTheGreetingIsAll) {
  Feed::Cursor cursor = viewer(begin(R"("digest":"ab","tags":[[0,2]])"));
  const auto before = drain(cursor);
  Feed::Cursor again = back(has(before[2], before[3], true));
  EXPECT_EQ(types(drain(again)), Types{"hello"});
}

TEST_F(Gap, WhenTheServerIsAnother_ThenEverythingComesAnew) {
  Feed::Cursor cursor = viewer();
  const auto before = drain(cursor);
  Feed other({"bench", "1"}, synoptic(), {.epoch = "e2"});
  other.update(view_, now_);
  Feed::Cursor again;
  ASSERT_EQ(other.hear(again, begin(R"("tags":"all")", has(before[2], before[3], true))), std::nullopt);
  std::vector<json> messages;
  while (const auto message = other.next(again)) messages.push_back(json::parse(*message));
  ASSERT_EQ(types(messages), (Types{"hello", "program", "state", "trend"}));
  EXPECT_EQ(messages[0]["epoch"], "e2");
  EXPECT_EQ(messages[3]["restart"], true);
}

TEST_F(Gap, WhenNoEpochIsGiven_ThenEveryServerHasItsOwn) {
  const auto epoch = [] {
    const Feed feed({"bench", "1"}, synoptic());
    Feed::Cursor cursor;
    return json::parse(*feed.next(cursor))["epoch"].get<std::string>();
  };
  EXPECT_EQ(epoch().size(), 16u);
  EXPECT_NE(epoch(), epoch());
}

TEST_F(Gap, WhenTheProgramChangedMeanwhile_ThenItComesWithAWholeState) {
  Feed::Cursor cursor = viewer();
  const auto before = drain(cursor);
  view_.layout = layout("cd");
  view_.state.program_digest = "cd";
  update();
  Feed::Cursor again = back(has(before[2], before[3], true));
  EXPECT_EQ(types(drain(again)), (Types{"hello", "program", "state"}));
}

TEST_F(Gap, WhenRowsThatAreMissedAreGone_ThenTheTrendComesAnewWithoutAHole) {
  Feed::Cursor cursor = viewer();
  const auto before = drain(cursor);
  for (int i = 0; i < 30; ++i) count();  // 20 are kept
  Feed::Cursor again = back(has(before[2], before[3], true));
  const auto messages = drain(again);
  ASSERT_EQ(messages[2]["type"], "trend");
  EXPECT_EQ(messages[2]["restart"], true);
  EXPECT_EQ(messages[2]["first"], 11);
}

TEST_F(Gap, WhenAnotherRunBeganMeanwhile_ThenTheTrendComesAnew) {
  view_.state.time_s = 50;
  count();
  Feed::Cursor cursor = viewer();
  const auto before = drain(cursor);
  view_.state.time_s = 0;
  count();
  Feed::Cursor again = back(has(before[2], before[3], true));
  EXPECT_EQ(drain(again).back()["restart"], true);
}

TEST_F(Gap, WhenAPageClaimsWhatNeverWas_ThenItGetsEverything) {
  Feed::Cursor again = back(
      R"("seq":9007199254740991,"tags":true,"program":99,"plan":99,"trend_run":0,"trend_next":9007199254740991)");
  const auto messages = drain(again);
  ASSERT_EQ(types(messages), (Types{"hello", "program", "state", "trend"}));
  EXPECT_EQ(messages[3]["restart"], true);
}

}  // namespace
}  // namespace stepwright::server

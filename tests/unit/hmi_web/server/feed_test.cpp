#include "hmi_web/server/feed.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stepwright::server {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

class FeedTest : public testing::Test {
 protected:
  FeedTest() {
    view_.state.runtime_alive = true;
    view_.state.points = {10.0, 1.0};
  }

  static protocol::Synoptic synoptic() {
    protocol::Synoptic result;
    result.points = {{"a1.level", "a1", "%", true}, {"fc1", "fc1", "", false}};
    return result;
  }

  static std::shared_ptr<const ProgramLayout> layout(const std::string& digest) {
    auto result = std::make_shared<ProgramLayout>();
    result->program.digest = digest;
    return result;
  }

  bool update() { return feed_.update(view_, now_); }

  // All that a viewer at `cursor` is told now.
  std::vector<json> drain(Feed::Cursor& cursor) const {
    std::vector<json> messages;
    while (const auto message = feed_.next(cursor)) messages.push_back(json::parse(*message));
    return messages;
  }

  static std::vector<std::string> types(const std::vector<json>& messages) {
    std::vector<std::string> result;
    for (const json& message : messages) result.push_back(message["type"]);
    return result;
  }

  Feed feed_{{"bench", "1"}, synoptic(), {.trend_rows_per_message = 3}};
  CellView view_;
  std::chrono::steady_clock::time_point now_{1h};
};

using Types = std::vector<std::string>;

TEST_F(FeedTest, WhenAViewerComes_ThenItIsToldEverythingInOrder) {
  view_.layout = layout("ab");
  view_.plan = R"({"phase":"executing"})";
  update();
  Feed::Cursor cursor;

  EXPECT_EQ(types(drain(cursor)), (Types{"hello", "program", "state", "plan", "trend"}));
  EXPECT_TRUE(drain(cursor).empty());
}

TEST_F(FeedTest, WhenAlarmsChange_ThenEveryViewerGetsTheNewestListOnce) {
  update();
  Feed::Cursor cursor;
  feed_.set_alarms(R"({"type":"alarms","count":1})");
  feed_.set_alarms(R"({"type":"alarms","count":2})");

  const auto messages = drain(cursor);
  EXPECT_EQ(types(messages), (Types{"hello", "state", "alarms", "trend"}));
  EXPECT_EQ(messages[2]["count"], 2);
  EXPECT_TRUE(drain(cursor).empty());
}

TEST_F(FeedTest, WhenNothingWasSeenYet_ThenAViewerIsGreetedOnly) {
  Feed::Cursor cursor;

  EXPECT_EQ(types(drain(cursor)), Types{"hello"});
}

TEST_F(FeedTest, WhenAValueChanges_ThenAReaderThatKeptUpGetsADelta) {
  update();
  Feed::Cursor cursor;
  drain(cursor);

  view_.state.points[1] = 0.0;
  EXPECT_TRUE(update());

  const auto messages = drain(cursor);
  ASSERT_EQ(types(messages), Types{"delta"});
  EXPECT_EQ(messages[0]["points"], json({{"1", 0}}));
}

TEST_F(FeedTest, WhenAReaderWasSlow_ThenItSkipsToTheWholeState) {
  update();
  Feed::Cursor cursor;
  drain(cursor);

  for (int i = 0; i < 5; ++i) {
    view_.state.scan += 1;
    update();
  }

  const auto messages = drain(cursor);
  ASSERT_EQ(types(messages), Types{"state"});
  EXPECT_EQ(messages[0]["scan"], 5);
}

TEST_F(FeedTest, WhenNothingChanges_ThenNothingIsSentUntilTheBeat) {
  update();
  Feed::Cursor cursor;
  drain(cursor);

  now_ += 900ms;
  EXPECT_FALSE(update());
  EXPECT_TRUE(drain(cursor).empty());
  now_ += 100ms;
  EXPECT_TRUE(update());

  const auto messages = drain(cursor);
  ASSERT_EQ(types(messages), Types{"delta"});
  EXPECT_EQ(messages[0].size(), 2u);  // type and number
}

TEST_F(FeedTest, WhenTheProgramChanges_ThenItsStructureComesBeforeItsValues) {
  view_.layout = layout("ab");
  update();
  Feed::Cursor cursor;
  drain(cursor);

  view_.layout = layout("cd");
  view_.state.program_digest = "cd";
  update();

  const auto messages = drain(cursor);
  ASSERT_EQ(types(messages), (Types{"program", "state"}));
  EXPECT_EQ(messages[0]["digest"], "cd");
  EXPECT_EQ(messages[1]["program"], "cd");
}

TEST_F(FeedTest, WhenTheProgramGoes_ThenAnEmptyOneIsSent) {
  view_.layout = layout("ab");
  update();
  Feed::Cursor cursor;
  drain(cursor);

  view_.layout = nullptr;
  update();

  EXPECT_EQ(drain(cursor)[0]["digest"], "");
}

TEST_F(FeedTest, WhenOnlyAStateOfAFleetChanges_ThenItsRoutesAreNotSentAgain) {
  view_.plan = R"({"fleet":{"paths":[],"vehicles":[{"vehicle":"v1","state":"driving"}]}})";
  update();
  Feed::Cursor cursor;
  EXPECT_EQ(types(drain(cursor)), (Types{"hello", "state", "routes", "plan", "trend"}));

  view_.plan = R"({"fleet":{"paths":[],"vehicles":[{"vehicle":"v1","state":"waiting"}]}})";
  update();
  EXPECT_EQ(types(drain(cursor)), Types{"plan"});

  view_.plan = R"({"fleet":{"paths":[{"vehicle":"v1"}],"vehicles":[]}})";
  update();
  EXPECT_EQ(types(drain(cursor)), (Types{"routes", "plan"}));
}

TEST_F(FeedTest, WhenThePlanIsBroken_ThenTheLastGoodOneStays) {
  view_.plan = R"({"phase":"executing"})";
  update();
  Feed::Cursor cursor;
  drain(cursor);

  view_.plan = "{ broken";
  EXPECT_FALSE(update());
  EXPECT_TRUE(drain(cursor).empty());
  Feed::Cursor late;
  const auto messages = drain(late);
  EXPECT_EQ(messages[2]["document"]["phase"], "executing");
}

TEST_F(FeedTest, WhenTheTrendIsLong_ThenItComesInPiecesWithoutAGap) {
  for (int i = 0; i < 8; ++i) {
    view_.state.time_s = i;
    now_ += 100ms;
    update();
  }
  Feed::Cursor cursor;

  std::vector<double> times;
  for (const json& message : drain(cursor)) {
    if (message["type"] != "trend") continue;
    EXPECT_EQ(message["first"], times.size());
    EXPECT_EQ(message["restart"], times.empty());
    for (const json& row : message["rows"]) times.push_back(row[0]);
  }
  EXPECT_EQ(times, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST_F(FeedTest, WhenAnotherRunBegins_ThenTheTrendStartsAnew) {
  view_.state.time_s = 50;
  update();
  Feed::Cursor cursor;
  drain(cursor);

  view_.state.time_s = 0.5;
  now_ += 100ms;
  update();

  const json trend = drain(cursor).back();
  EXPECT_EQ(trend["restart"], true);
  EXPECT_EQ(trend["rows"], json({{0.5, 10}}));
}

TEST_F(FeedTest, WhenTheRuntimeIsGone_ThenTheTrendDoesNotGoOn) {
  update();
  Feed::Cursor cursor;
  drain(cursor);

  view_.state.runtime_alive = false;
  view_.state.time_s = 9;
  now_ += 100ms;
  update();

  EXPECT_EQ(types(drain(cursor)), Types{"delta"});
}

}  // namespace
}  // namespace stepwright::server

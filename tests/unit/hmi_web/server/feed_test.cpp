#include "hmi_web/server/feed.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stepwright::server {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

class FeedTest : public testing::Test {
 protected:
  static constexpr int kTags = 10;

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
    for (int i = 0; i < kTags; ++i) result->program.tags.push_back({"t" + std::to_string(i), "DINT", ""});
    return result;
  }

  bool update() { return feed_.update(view_, now_); }

  // What a page says first that shows everything, and one that has something already.
  static std::string begin(const std::string& show = R"("tags":"all")", const std::string& has = {}) {
    return R"({"type":"begin","protocol":3,"epoch":"e1",)" + (has.empty() ? "" : "\"has\":{" + has + "},") +
           R"("show":{"number":1,"also":["plan","routes","trend"],)" + show + "}}";
  }
  static std::string show(int number, const std::string& tags) {
    return R"({"type":"show","number":)" + std::to_string(number) + R"(,"digest":"ab","tags":)" + tags + "}";
  }
  Feed::Cursor viewer(const std::string& first = begin()) const {
    Feed::Cursor cursor;
    EXPECT_EQ(feed_.hear(cursor, first), std::nullopt);
    return cursor;
  }

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

  Feed feed_{{"bench", "1"}, synoptic(), {.trend_rows = 20, .trend_rows_per_message = 3, .epoch = "e1"}};
  CellView view_;
  std::chrono::steady_clock::time_point now_{1h};
};

using Types = std::vector<std::string>;

TEST_F(FeedTest, WhenAViewerComes_ThenItIsToldEverythingInOrder) {
  view_.layout = layout("ab");
  view_.plan = R"({"phase":"executing"})";
  update();
  Feed::Cursor cursor = viewer();

  EXPECT_EQ(types(drain(cursor)), (Types{"hello", "program", "state", "plan", "trend"}));
  EXPECT_TRUE(drain(cursor).empty());
}

TEST_F(FeedTest, WhenAlarmsChange_ThenEveryViewerGetsTheNewestListOnce) {
  update();
  Feed::Cursor cursor = viewer();
  feed_.set_alarms(R"({"type":"alarms","count":1})");
  feed_.set_alarms(R"({"type":"alarms","count":2})");

  const auto messages = drain(cursor);
  EXPECT_EQ(types(messages), (Types{"hello", "state", "alarms", "trend"}));
  EXPECT_EQ(messages[2]["count"], 2);
  EXPECT_TRUE(drain(cursor).empty());
}

TEST_F(FeedTest, WhenNothingWasSeenYet_ThenAViewerIsGreetedOnly) {
  Feed::Cursor cursor = viewer();

  EXPECT_EQ(types(drain(cursor)), Types{"hello"});
}

TEST_F(FeedTest, WhenAValueChanges_ThenAReaderThatKeptUpGetsADelta) {
  update();
  Feed::Cursor cursor = viewer();
  drain(cursor);

  view_.state.points[1] = 0.0;
  EXPECT_TRUE(update());

  const auto messages = drain(cursor);
  ASSERT_EQ(types(messages), Types{"delta"});
  EXPECT_EQ(messages[0]["points"], json({{"1", 0}}));
}

TEST_F(FeedTest, WhenAReaderWasSlow_ThenOneDeltaHasAllThatItMissed) {
  update();
  Feed::Cursor cursor = viewer();
  drain(cursor);

  view_.state.points[1] = 0.0;
  for (int i = 0; i < 5; ++i) {
    view_.state.scan += 1;
    update();
  }

  const auto messages = drain(cursor);
  ASSERT_EQ(types(messages), Types{"delta"});
  EXPECT_EQ(messages[0]["scan"], 5);
  EXPECT_EQ(messages[0]["seq"], 6);
  EXPECT_EQ(messages[0]["points"], json({{"1", 0}}));
}

TEST_F(FeedTest, WhenNothingChanges_ThenNothingIsSentUntilTheBeat) {
  update();
  Feed::Cursor cursor = viewer();
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
  Feed::Cursor cursor = viewer();
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
  Feed::Cursor cursor = viewer();
  drain(cursor);

  view_.layout = nullptr;
  update();

  EXPECT_EQ(drain(cursor)[0]["digest"], "");
}

TEST_F(FeedTest, WhenOnlyAStateOfAFleetChanges_ThenItsRoutesAreNotSentAgain) {
  view_.plan = R"({"fleet":{"paths":[],"vehicles":[{"vehicle":"v1","state":"driving"}]}})";
  update();
  Feed::Cursor cursor = viewer();
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
  Feed::Cursor cursor = viewer();
  drain(cursor);

  view_.plan = "{ broken";
  EXPECT_FALSE(update());
  EXPECT_TRUE(drain(cursor).empty());
  Feed::Cursor late = viewer();
  const auto messages = drain(late);
  EXPECT_EQ(messages[2]["document"]["phase"], "executing");
}

TEST_F(FeedTest, WhenTheTrendIsLong_ThenItComesInPiecesWithoutAGap) {
  for (int i = 0; i < 8; ++i) {
    view_.state.time_s = i;
    now_ += 100ms;
    update();
  }
  Feed::Cursor cursor = viewer();

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
  Feed::Cursor cursor = viewer();
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
  Feed::Cursor cursor = viewer();
  drain(cursor);

  view_.state.runtime_alive = false;
  view_.state.time_s = 9;
  now_ += 100ms;
  update();

  EXPECT_EQ(types(drain(cursor)), Types{"delta"});
}

class ChosenTags : public FeedTest {
 protected:
  ChosenTags() {
    view_.layout = layout("ab");
    view_.state.program_digest = "ab";
    for (int i = 0; i < kTags; ++i) view_.state.tags.push_back(i);
    update();
  }
  void count() {
    view_.state.scan += 1;
    for (auto& tag : view_.state.tags) *tag += 100;
    now_ += 100ms;
    view_.state.time_s += 0.1;
    update();
  }
  json newest(Feed::Cursor& cursor) const {
    json found;
    for (const json& message : drain(cursor)) {
      if (message["type"] == "state" || message["type"] == "delta") found = message;
    }
    return found;
  }
};

TEST_F(ChosenTags, WhenAPageShowsNone_ThenItIsToldOfNone) {
  Feed::Cursor cursor = viewer(begin(R"("tags":[])"));
  EXPECT_EQ(newest(cursor)["tags"], json::object());
  count();
  const json delta = newest(cursor);
  EXPECT_EQ(delta["scan"], 1);
  EXPECT_FALSE(delta.contains("tags"));
}

TEST_F(ChosenTags, WhenAPageChoosesOthers_ThenTheyComeWholeOnceAndTheOldOnesNoMore) {
  Feed::Cursor cursor = viewer(begin(R"("digest":"ab","tags":[[0,2]])"));
  EXPECT_EQ(newest(cursor)["tags"], json({{"0", 0}, {"1", 1}}));
  ASSERT_EQ(feed_.hear(cursor, show(2, "[[1,1],[8,2]]")), std::nullopt);

  const json answer = newest(cursor);
  EXPECT_EQ(answer["type"], "delta");
  EXPECT_EQ(answer["show"], 2);
  EXPECT_EQ(answer["tags"], json({{"1", 1}, {"8", 8}, {"9", 9}}));
  view_.state.tags[0] = 5.0;
  view_.state.tags[8] = 6.0;
  update();
  EXPECT_EQ(newest(cursor)["tags"], json({{"8", 6}}));
}

TEST_F(ChosenTags, WhenPagesWantTheSame_ThenTheyGetOneText) {
  Feed::Cursor first = viewer();
  Feed::Cursor second = viewer();
  Feed::Cursor other = viewer(begin(R"("tags":[])"));
  for (Feed::Cursor* cursor : {&first, &second, &other}) drain(*cursor);
  count();

  const MessageText text = feed_.next(first);
  ASSERT_NE(text, nullptr);
  EXPECT_EQ(feed_.next(second), text);
  EXPECT_NE(feed_.next(other), text);
}

TEST_F(ChosenTags, WhenTheProgramIsAnother_ThenItsTagsAreNotTakenForThose) {
  Feed::Cursor cursor = viewer(begin(R"("digest":"ab","tags":[[0,10]])"));
  drain(cursor);
  view_.layout = layout("cd");
  view_.state.program_digest = "cd";
  update();
  EXPECT_EQ(newest(cursor)["tags"], json::object());

  // A page that is told of it later says what it wants of the old one meanwhile: no mistake of its own.
  EXPECT_EQ(feed_.hear(cursor, show(2, "[[0,1000]]")), std::nullopt);
  EXPECT_EQ(newest(cursor)["tags"], json::object());
}

TEST_F(ChosenTags, WhenAPageSaysWhatCannotBe_ThenTheReasonIsNamed) {
  Feed::Cursor cursor = viewer();
  EXPECT_EQ(feed_.hear(cursor, show(2, "[[0,11]]")), "the program has no such tag");
  EXPECT_EQ(feed_.hear(cursor, begin()), "a page begins once, and before all else");
  EXPECT_EQ(feed_.hear(cursor, "[1"), "the message is not JSON");
  Feed::Cursor early;
  EXPECT_EQ(feed_.hear(early, show(1, "[]")), "a page begins once, and before all else");
  EXPECT_EQ(feed_.hear(early, R"({"type":"begin","protocol":2,"show":{"number":1}})"),
            "protocol 3 is spoken here");
}

TEST_F(ChosenTags, WhenAPageHasNotBegun_ThenItIsGreetedOnly) {
  Feed::Cursor cursor;
  EXPECT_EQ(types(drain(cursor)), Types{"hello"});
  ASSERT_EQ(feed_.hear(cursor, begin()), std::nullopt);
  EXPECT_EQ(types(drain(cursor)), (Types{"program", "state", "trend"}));
}

TEST_F(ChosenTags, WhenAPartIsNotShown_ThenItIsNotSent) {
  view_.plan = R"({"fleet":{"paths":[],"vehicles":[]}})";
  update();
  Feed::Cursor cursor = viewer(R"({"type":"begin","protocol":3,"show":{"number":1,"also":["plan"]}})");
  EXPECT_EQ(types(drain(cursor)), (Types{"hello", "program", "state", "plan"}));
  ASSERT_EQ(feed_.hear(cursor, R"({"type":"show","number":2,"also":["plan","trend"]})"), std::nullopt);
  EXPECT_EQ(types(drain(cursor)), (Types{"delta", "trend"}));
}

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

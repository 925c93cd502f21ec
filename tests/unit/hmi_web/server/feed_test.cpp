#include "hmi_web/server/feed.h"

#include <nlohmann/json.hpp>

#include "tests/unit/hmi_web/server/feed_fixture.h"

namespace stepwright::server {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

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

TEST_F(FeedTest, WhenStatesComeFasterThanTheyAreSent_ThenTheNewestFollowsInTime) {
  Feed paced({"bench", "1"}, synoptic(), {.state_spacing = 100ms, .epoch = "e1"});
  paced.update(view_, now_);
  Feed::Cursor cursor = viewer();
  while (paced.next(cursor)) continue;

  for (const auto passed : {30ms, 60ms}) {
    now_ += passed;
    view_.state.points[1] = *view_.state.points[1] + 1;
    paced.update(view_, now_);
    EXPECT_EQ(paced.next(cursor), nullptr) << passed.count();
  }
  now_ += 10ms;
  EXPECT_TRUE(paced.update(view_, now_)) << "though nothing has changed since the last look";

  const auto delta = paced.next(cursor);
  ASSERT_NE(delta, nullptr);
  EXPECT_EQ(json::parse(*delta)["points"], json({{"1", 3}}));
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

TEST_F(FeedTest, WhenPicturesChange_ThenTheyAreSentOnceAndBeforeTheirPlan) {
  view_.plan = R"({"phase":"executing"})";
  view_.pictures = R"({"pictures":[{"kind":"floor","id":"hall"}]})";
  update();
  Feed::Cursor cursor = viewer();
  EXPECT_EQ(types(drain(cursor)), (Types{"hello", "state", "pictures", "plan", "trend"}));

  view_.plan = R"({"phase":"done"})";
  update();
  EXPECT_EQ(types(drain(cursor)), Types{"plan"});

  view_.pictures = R"({"pictures":[{"kind":"floor","id":"hall","length_m":3}]})";
  update();
  const auto messages = drain(cursor);
  ASSERT_EQ(types(messages), Types{"pictures"});
  EXPECT_EQ(messages[0]["revision"], 2);
  EXPECT_EQ(messages[0]["pictures"][0]["length_m"], 3);

  view_.pictures = "{ broken";
  EXPECT_FALSE(update());
  Feed::Cursor back = viewer(begin(R"("tags":"all")", R"("seq":1,"pictures":2)"));
  for (const std::string& type : types(drain(back))) EXPECT_NE(type, "pictures") << "it has them";
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
  EXPECT_EQ(feed_.hear(early, R"({"type":"begin","protocol":3,"show":{"number":1}})"),
            "protocol 5 is spoken here");
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
  Feed::Cursor cursor = viewer(R"({"type":"begin","protocol":5,"show":{"number":1,"also":["plan"]}})");
  EXPECT_EQ(types(drain(cursor)), (Types{"hello", "program", "state", "plan"}));
  ASSERT_EQ(feed_.hear(cursor, R"({"type":"show","number":2,"also":["plan","trend"]})"), std::nullopt);
  EXPECT_EQ(types(drain(cursor)), (Types{"delta", "trend"}));
}

}  // namespace
}  // namespace stepwright::server

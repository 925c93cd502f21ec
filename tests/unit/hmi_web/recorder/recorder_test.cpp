#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "hmi_web/api/route_table.h"
#include "hmi_web/api/routes.h"
#include "hmi_web/recorder/cell_recorder.h"
#include "hmi_web/recorder/history_clock.h"
#include "hmi_web/recorder/record_queries.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::recorder {
namespace {

using bytecode::ElementaryType;
using nlohmann::json;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kWall = 1'700'000'000 * kSecond;

TEST(HistoryClock, WhenScansCome_ThenTheirDistancesAreKeptAndTheFirstIsNow) {
  HistoryClock clock(true);
  EXPECT_EQ(clock.at(5 * kSecond, kWall), kWall);
  EXPECT_EQ(clock.at(5 * kSecond + 10'000'000, kWall + 30'000'000), kWall + 10'000'000);
}

TEST(HistoryClock, WhenRealTimeIsSetForward_ThenTheRunFollowsItAfterHalfAMinute) {
  constexpr std::int64_t kHour = 3'600 * kSecond;
  HistoryClock clock(true);
  EXPECT_EQ(clock.at(0, kWall), kWall);
  for (int s = 1; s < 30; ++s)
    EXPECT_EQ(clock.at(s * kSecond, kWall + kHour + s * kSecond), kWall + s * kSecond);
  clock.at(30 * kSecond, kWall + kHour + 30 * kSecond);
  EXPECT_EQ(clock.at(31 * kSecond, kWall + kHour + 31 * kSecond), kWall + kHour + 31 * kSecond);
  EXPECT_EQ(clock.at(32 * kSecond, kWall + 32 * kSecond), kWall + kHour + 32 * kSecond) << "never back";
}

TEST(HistoryClock, WhenImagesThatWaitedComeTogether_ThenRealTimeWasNotSet) {
  HistoryClock clock(true);
  clock.at(0, kWall);
  // Those of two minutes within a second.
  for (int s = 1; s <= 120; ++s)
    EXPECT_EQ(clock.at(s * kSecond, kWall + 121 * kSecond + s * kSecond / 120), kWall + s * kSecond);
  EXPECT_EQ(clock.at(160 * kSecond, kWall + 160 * kSecond), kWall + 160 * kSecond);
}

TEST(HistoryClock, WhenTimeIsSimulated_ThenItGoesAtItsOwnPace) {
  HistoryClock clock(false);
  clock.at(0, kWall);
  for (int s = 1; s < 100; ++s)
    EXPECT_EQ(clock.at(s * kSecond, kWall + 10 * s * kSecond), kWall + s * kSecond)
        << "slower than real time";
}

TEST(HistoryClock, WhenAnotherRunBegins_ThenItStandsBehindTheOneBefore) {
  HistoryClock clock(false);
  clock.at(0, kWall);
  const std::int64_t end = clock.at(3'600 * kSecond, kWall + kSecond);  // an hour in a second
  const std::int64_t next = clock.at(0, kWall + 2 * kSecond);
  EXPECT_GT(next, end);
  EXPECT_EQ(clock.at(kSecond, kWall + 3 * kSecond), next + kSecond);
}

TEST(HistoryClock, WhenTheProcessStartsAgain_ThenTheSameRunGoesOnAndAnotherIsTold) {
  const KnownEpoch known{kWall, kWall + 10 * kSecond};
  EXPECT_EQ(HistoryClock(true, known).at(60 * kSecond, kWall + 61 * kSecond), kWall + 60 * kSecond);
  EXPECT_EQ(HistoryClock(true, known).at(60 * kSecond, kWall + 500 * kSecond), kWall + 500 * kSecond)
      << "the scan's time does not fit: the runtime has started again meanwhile";
  EXPECT_EQ(HistoryClock(false, known).at(60 * kSecond, kWall + 500 * kSecond), kWall + 60 * kSecond)
      << "simulated time goes at a pace of its own";
  EXPECT_GT(HistoryClock(false, known).at(2 * kSecond, kWall - 500 * kSecond), known.newest_ns);
}

TEST(HistoryClock, WhenNoScanComes_ThenTimeGoesOnAndNeverBack) {
  HistoryClock clock(true);
  clock.at(0, kWall);
  EXPECT_EQ(clock.without_scan(kWall + 3 * kSecond), kWall + 3 * kSecond);
  EXPECT_EQ(clock.without_scan(kWall + 2 * kSecond), kWall + 3 * kSecond) << "real time was set back";
  EXPECT_GE(clock.at(kSecond, kWall + 4 * kSecond), kWall + 3 * kSecond);
}

TEST(HistoryClock, WhenRealTimeHasPassedSinceTheRunBefore_ThenTheNextBeginsNow) {
  const KnownEpoch known{kWall, kWall + 10 * kSecond};
  HistoryClock clock(true, known);
  EXPECT_EQ(clock.without_scan(kWall + 15 * kSecond), kWall + 15 * kSecond);
  EXPECT_EQ(clock.passed(kWall + 16 * kSecond), kWall + 16 * kSecond);
  EXPECT_EQ(clock.at(kSecond, kWall + 16 * kSecond), kWall + 16 * kSecond);
}

// A server always looks before the first image has come.
TEST(HistoryClock, WhenItWasLookedAtBeforeTheFirstScan_ThenItKeepsToRealTime) {
  HistoryClock clock(true);
  clock.without_scan(kWall);
  EXPECT_EQ(clock.at(70 * kSecond, kWall + kSecond / 10), kWall + kSecond / 10);
}

TEST(HistoryClock, WhenScansStayAwayForAWhile_ThenTheRunGoesOnAsItWas) {
  HistoryClock clock(true);
  clock.at(0, kWall);
  clock.without_scan(kWall + 3 * kSecond);
  const std::int64_t old = 3 * kSecond - kSecond / 50;  // a snapshot is a little old
  EXPECT_EQ(clock.at(old, kWall + 3 * kSecond), kWall + 3 * kSecond) << "never back";
  EXPECT_EQ(clock.at(4 * kSecond, kWall + 4 * kSecond), kWall + 4 * kSecond);
  EXPECT_GE(clock.at(kSecond, kWall + 5 * kSecond), kWall + 5 * kSecond) << "another run";
  const KnownEpoch known{kWall, kWall + 50 * kSecond};
  HistoryClock restarted(true, known);
  restarted.without_scan(kWall + 60 * kSecond);
  EXPECT_EQ(restarted.at(60 * kSecond - kSecond / 50, kWall + 60 * kSecond), kWall + 60 * kSecond);
  EXPECT_EQ(restarted.at(61 * kSecond, kWall + 61 * kSecond), kWall + 61 * kSecond);
}

// A level of a picture, an INT of the program, and the monitors of a plan.
class RecorderTest : public testing::Test {
 protected:
  RecorderTest() : layout_(std::make_shared<server::ProgramLayout>()) {
    options_.folder = folder_ / "history";
    options_.steady_clock = [this] { return steady_ns_; };
    options_.points = {{"a1.level", "Level of a1", "%", true}};
    protocol::Synoptic synoptic;
    synoptic.tanks = {{"a1", "A1", protocol::TankSide::Below, "", "a1.level", "", 20.0, 90.0}};
    options_.alarms = built_in_alarms(synoptic, {.supervisor = false, .monitors = 3});
    layout_->program.digest = "ab";
    const char* const names[] = {"plan.speed", "MON_NOW", "MON_SCAN[1]", "MON_SCAN[2]", "MON_SCAN[3]"};
    for (std::uint32_t i = 0; i < 5; ++i) {
      layout_->program.tags.push_back({names[i], "DINT", ""});
      layout_->tags.push_back({ElementaryType::Dint, 4 * i, bytecode::kNoBit});
    }
  }
  void open() {
    recorder_.reset();
    auto made = CellRecorder::open(options_, [this] { return wall_ns_; });
    ASSERT_TRUE(made.has_value()) << result::to_string(made.error());
    recorder_ = std::move(*made);
  }
  // An image at a time of the scan; real time is an hour later than that.
  std::optional<std::string> look(double time_s, std::vector<std::int32_t> values, double level,
                                  bool alive = true, std::optional<double> wall_s = {}) {
    wall_ns_ = kWall + static_cast<std::int64_t>(wall_s.value_or(time_s) * 1e9);
    steady_ns_ = wall_ns_ - set_forward_ns_;
    newest_s_ = time_s;
    server::Observation seen;
    seen.runtime_alive = alive;
    seen.layout = layout_;
    values.resize(5);
    std::vector<std::byte> image(20);
    std::memcpy(image.data(), values.data(), image.size());
    if (alive) seen.snapshot = server::ImageSnapshot{++scan_, time_s, image, {}};
    seen.images = images_;
    seen.images_lost = images_lost_;
    server::CellView view;
    view.layout = layout_;
    view.state.points = {level};
    for (const std::int32_t value : values) view.state.tags.push_back(value);
    view.state.unread = unread_;
    return recorder_->take(seen, view);
  }
  // The newest image once more, or nothing new: as `images_` says.
  void again(double wall_s) {
    wall_ns_ = kWall + static_cast<std::int64_t>(wall_s * 1e9);
    steady_ns_ = wall_ns_ - set_forward_ns_;
    server::Observation seen;
    seen.runtime_alive = true;
    seen.layout = layout_;
    seen.snapshot = server::ImageSnapshot{scan_, newest_s_, std::vector<std::byte>(20), {}};
    seen.images = images_;
    server::CellView view;
    view.layout = layout_;
    view.state.points = {50.0};
    view.state.tags.resize(5);
    recorder_->take(seen, view);
  }
  // As the API's routes answer it.
  api::Answer ask(const std::string& target, bool flush = true) {
    if (flush) {
      EXPECT_TRUE(recorder_->flush().has_value());
    }
    RecordQueries records(*recorder_);
    const api::RouteTable table(api::record_routes({.records = &records}));
    api::Match match = table.find("GET", target);
    if (match.route == nullptr) return {.status = 404, .text = "{}"};
    return match.route->handler({.who = {}, .parameters = std::move(match.parameters), .body = {}});
  }
  json answer(const std::string& target, unsigned status = 200) {
    const api::Answer reply = ask(target);
    EXPECT_EQ(reply.status, status) << target << ": " << reply.text;
    return json::parse(reply.text);
  }
  json trend(const std::string& tag, double from_s, double to_s, int columns) {
    const auto ms = [](double s) { return std::to_string(static_cast<double>(kWall / 1'000'000) + s * 1e3); };
    return answer("/api/history/trend?tags=" + tag + "&from_ms=" + ms(from_s) + "&to_ms=" + ms(to_s) +
                  "&columns=" + std::to_string(columns));
  }

  support::TemporaryFolder folder_;
  RecorderOptions options_;
  std::shared_ptr<server::ProgramLayout> layout_;
  std::unique_ptr<CellRecorder> recorder_;
  std::int64_t wall_ns_ = kWall;
  std::int64_t steady_ns_ = kWall;
  std::int64_t set_forward_ns_ = 0;  // real time by somebody; below zero: back
  std::uint64_t scan_ = 0;
  double newest_s_ = 0.0;
  std::uint64_t images_ = 0, images_lost_ = 0;  // 0: the source cannot tell
  std::vector<protocol::UnreadDevice> unread_;
};

TEST_F(RecorderTest, WhenImagesAreSeen_ThenPointsAndTagsAreReadBackAtTheTimesOfTheirScans) {
  open();
  look(0.0, {5}, 50.0);
  look(1.0, {7}, 51.0);
  look(2.0, {7}, 49.0);
  EXPECT_EQ(answer("/api/history/tags")["tags"],
            json({"MON_NOW", "MON_SCAN[1]", "MON_SCAN[2]", "MON_SCAN[3]", "plan.speed", "points/a1.level"}));
  const json levels = trend("points/a1.level;plan.speed", 0.0, 2.999999, 3);
  EXPECT_EQ(levels["series"][0]["last"], json({50.0, 51.0, 49.0})) << levels.dump();
  EXPECT_EQ(levels["series"][0]["greatest"], json({50.0, 51.0, 51.0})) << "51 holds until 49 comes";
  EXPECT_EQ(levels["series"][1]["last"][1], 7.0) << "a value that repeats holds";
  const auto csv = ask("/api/history/export.csv?tags=plan.speed&from_ms=0");
  EXPECT_EQ(csv.content_type, "text/csv; charset=utf-8");
  EXPECT_NE(csv.text.find("plan.speed,2023-11-14T22:13:21Z,7,good\r\n"), std::string::npos) << csv.text;
}

TEST_F(RecorderTest, WhenTheRuntimeIsLost_ThenNothingHoldsAndAnAlarmHasItsTime) {
  open();
  look(0.0, {5}, 50.0);
  look(10.0, {5}, 50.0);
  look(11.0, {}, 0.0, false);
  look(20.0, {}, 0.0, false);
  look(30.0, {5}, 50.0);
  look(30.9, {5}, 50.0);
  const json entries = answer("/api/alarms/journal?alarm=runtime.lost")["entries"];
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[1]["event"], "raise");
  EXPECT_EQ(entries[1]["time_ms"], kWall / 1'000'000 + 13'000) << "two seconds after it was lost";
  EXPECT_EQ(entries[0]["event"], "return");
  const json levels = trend("points/a1.level", 0.0, 31.0, 31)["series"][0]["last"];
  EXPECT_EQ(levels[9], 50.0);
  EXPECT_TRUE(levels[15].is_null());
  EXPECT_EQ(levels[30], 50.0);
}

// The clock leaves out two seconds behind a run that it saw: they are no time in which nobody answered.
TEST_F(RecorderTest, WhenTheServerIsUpBeforeItsRuntime_ThenThatIsNotLost) {
  for (const bool real : {true, false}) {
    options_.real_time = real;
    open();
    look(10.0, {5}, 50.0);
    look(real ? 11.0 : 500.0, {5}, 50.0, true, 11.0);
    ASSERT_TRUE(recorder_->flush().has_value());
    open();
    look(0.0, {}, 0.0, false, 11.1);
    look(0.0, {}, 0.0, false, 12.0);
    look(0.1, {5}, 50.0, true, 12.9);
    look(0.2, {5}, 50.0, true, 13.0);
    EXPECT_EQ(answer("/api/alarms/journal?alarm=runtime.lost")["entries"].size(), 0u) << real;
  }
}

TEST_F(RecorderTest, WhenTheCalendarIsWrongAtOneStart_ThenNothingIsDeletedAndNoTimeStaysThere) {
  options_.most_age = std::chrono::hours(24 * 30);
  options_.steady_clock = [this] { return wall_ns_ - kWall + kSecond; };
  open();
  look(0.0, {5}, 50.0);
  look(1.0, {7}, 51.0);
  ASSERT_TRUE(recorder_->flush().has_value());
  recorder_.reset();
  const double year_s = 400.0 * 86'400;
  open();
  look(0.0, {8}, 60.0, true, year_s);
  EXPECT_EQ(answer("/api/history/tags")["status"]["calendar_ahead_s"], 400 * 86'400 - 1);
  look(1.0, {9}, 61.0, true, year_s + 1);
  ASSERT_TRUE(recorder_->flush().has_value());
  recorder_.reset();
  options_.steady_clock = [this] { return wall_ns_ - kWall + kSecond; };
  open();
  look(0.0, {3}, 70.0, true, 100.0);
  const json tags = answer("/api/history/tags");
  EXPECT_EQ(tags["status"]["calendar_ahead_s"], 0);
  EXPECT_EQ(tags["now_ms"], kWall / 1'000'000 + 100'000) << "as if the wrong start had been a right one";
  const std::string csv = ask("/api/history/export.csv?tags=points/a1.level&from_ms=0").text;
  for (const char* value : {",50,", ",51,", ",60,", ",61,", ",70,"})
    EXPECT_NE(csv.find(value), std::string::npos) << csv;
  const json entries = answer("/api/alarms/journal")["entries"];
  for (const json& entry : entries) EXPECT_LE(entry["time_ms"], kWall / 1'000'000 + 100'000);
}

TEST_F(RecorderTest, WhenImagesAreLostOnTheirWay_ThenTheHistoryHasAGapAndNoValueThatLasts) {
  open();
  const auto image = [&](double time_s, double level, std::uint64_t lost) {
    ++images_;
    images_lost_ += lost;
    look(time_s, {5}, level);
  };
  image(0.00, 50.0, 0);
  image(0.03, 50.0, 0);
  image(0.09, 51.0, 1);  // nobody looks that often
  image(0.12, 51.0, 0);
  image(0.52, 51.0, 12);  // the same value, and yet nobody knows what it was meanwhile
  image(0.80, 52.0, 0);   // a busy machine: late, but nothing is lost
  const json levels = trend("points/a1.level", 0.0, 1.0, 100)["series"][0]["last"];
  EXPECT_EQ(levels[6], 50.0);
  EXPECT_EQ(levels[11], 51.0);
  for (int i = 13; i < 51; ++i) EXPECT_TRUE(levels[i].is_null()) << i;
  for (int i = 53; i < 79; ++i) EXPECT_EQ(levels[i], 51.0) << i;
  const std::string csv =
      ask("/api/history/export.csv?tags=points/a1.level&to_ms=" + std::to_string(kWall / 1'000'000 + 1'000))
          .text;
  EXPECT_NE(csv.find(",missing\r\n"), std::string::npos) << csv;
}

TEST_F(RecorderTest, WhenTheProcessWasKilled_ThenNoValueLastsOverTheTimeInWhichNobodyLooked) {
  open();
  look(0.0, {5}, 50.0);
  look(1.0, {7}, 51.0);
  ASSERT_TRUE(recorder_->flush().has_value());
  // What a process leaves that has no time for an end.
  std::filesystem::copy(options_.folder, folder_ / "killed");
  options_.folder = folder_ / "killed";
  open();
  look(60.0, {7}, 51.0);
  const json series = trend("points/a1.level;plan.speed", 0.0, 60.999999, 61)["series"];
  for (const json& one : series) {
    EXPECT_FALSE(one["greatest"][1].is_null()) << one.dump();
    for (int i = 2; i < 60; ++i) EXPECT_TRUE(one["last"][i].is_null()) << i << one.dump();
    EXPECT_FALSE(one["last"][60].is_null()) << one.dump();
  }
  recorder_.reset();  // in order: nothing is added to what this one says itself
  open();
  look(70.0, {7}, 51.0);
  const std::string csv = ask("/api/history/export.csv?tags=plan.speed&from_ms=0").text;
  EXPECT_EQ(std::ranges::count(csv, '\n'), 7) << csv;
}

TEST_F(RecorderTest, WhenADeviceDoesNotAnswer_ThenItsTagsAreMissingUntilItDoes) {
  open();
  look(0.0, {5, 8}, 50.0);
  unread_ = {{"drive", protocol::Unread::Lost, {0}}};
  look(1.0, {5, 8}, 50.0);
  look(2.0, {5, 9}, 50.0);
  unread_.clear();
  look(3.0, {5, 9}, 50.0);
  const json series = trend("plan.speed;MON_NOW", 0.0, 3.999999, 4)["series"];
  EXPECT_EQ(series[0]["last"], json({5.0, nullptr, nullptr, 5.0})) << series.dump();
  EXPECT_EQ(series[1]["last"], json({8.0, 8.0, 9.0, 9.0})) << "another device";
  const std::string csv = ask("/api/history/export.csv?tags=plan.speed&from_ms=0").text;
  EXPECT_NE(csv.find("plan.speed,2023-11-14T22:13:21Z,0,missing\r\n"), std::string::npos) << csv;
}

TEST_F(RecorderTest, WhenNoImageComesThoughTheRuntimeAnswers_ThenTheGapBeginsWithTheNewestOne) {
  open();
  images_ = 1;
  look(0.0, {5}, 50.0);
  ++images_;
  look(0.35, {5}, 50.0);
  again(0.8);
  again(1.5);
  ++images_;
  look(3.0, {5}, 50.0);
  ++images_;
  look(3.3, {5}, 50.0);
  const json levels = trend("points/a1.level", 0.0, 4.0, 40)["series"][0]["last"];
  for (int i = 0; i < 3; ++i) EXPECT_EQ(levels[i], 50.0) << i;
  for (int i = 4; i < 29; ++i) EXPECT_TRUE(levels[i].is_null()) << i;
  EXPECT_EQ(levels[31], 50.0);
}

// A server that stood still for seconds finds what came first while it did, and what comes now.
// By two hours, as a machine whose clock keeps local time may do.
TEST_F(RecorderTest, WhenRealTimeIsSetBack_ThenAGapIsAGapAllTheSameAndThePageIsToldHowFarTheRecordIsAhead) {
  options_.real_time = true;
  open();
  images_ = 1;
  look(0.0, {5}, 50.0);
  EXPECT_EQ(answer("/api/history/tags")["status"]["ahead_s"], 0);
  set_forward_ns_ = -7'200 * kSecond;
  const double back_s = -7'200.0;
  ++images_;
  look(0.3, {5}, 50.0, true, back_s + 0.3);
  again(back_s + 0.8);
  again(back_s + 2.0);  // no image for more than a second
  ++images_;
  look(3.0, {5}, 51.0, true, back_s + 3.0);
  const json levels = trend("points/a1.level", 0.0, 4.0, 40)["series"][0]["last"];
  EXPECT_EQ(levels[0], 50.0) << levels.dump();
  for (int i = 4; i < 29; ++i) EXPECT_TRUE(levels[i].is_null()) << i;
  EXPECT_EQ(answer("/api/history/tags")["status"]["ahead_s"], 7'200);
}

TEST_F(RecorderTest, WhenRealTimeIsSetForward_ThenNothingThatWasSeenIsMissing) {
  options_.real_time = true;
  open();
  images_ = 1;
  look(0.0, {5}, 50.0);
  set_forward_ns_ = 7'200 * kSecond;
  for (const double s : {0.1, 0.2, 0.3}) {
    ++images_;
    look(s, {5}, 50.0, true, 7'200.0 + s);
  }
  const std::string csv = ask("/api/history/export.csv?tags=points/a1.level&from_ms=0").text;
  EXPECT_EQ(csv.find("missing"), std::string::npos) << csv;
}

TEST_F(RecorderTest, WhenImagesThatWaitedComeTogether_ThenTheTimeBetweenThemIsAGap) {
  open();
  images_ = 1;
  look(0.0, {5}, 50.0);
  for (const double time_s : {0.3, 2.8, 3.1}) {
    ++images_;
    look(time_s, {5}, 50.0, true, /*wall_s=*/std::max(2.8, time_s));
  }
  const json levels = trend("points/a1.level", 0.0, 3.2, 32)["series"][0]["last"];
  for (int i = 4; i < 27; ++i) EXPECT_TRUE(levels[i].is_null()) << i;
  EXPECT_EQ(levels[29], 50.0);
}

// What has not been written yet may be a gap.
TEST_F(RecorderTest, WhenImagesAreStillToBeWritten_ThenNoValueHoldsThroughTheirTime) {
  open();
  look(0.0, {5}, 50.0);
  ASSERT_TRUE(recorder_->flush().has_value());
  look(10.5, {5}, 51.0);
  const std::string target =
      "/api/history/trend?tags=points/a1.level&columns=20&from_ms=" + std::to_string(kWall / 1'000'000) +
      "&to_ms=" + std::to_string(kWall / 1'000'000 + 20'000);
  const json early = json::parse(ask(target, /*flush=*/false).text);
  EXPECT_EQ(early["now_ms"], kWall / 1'000'000 + 10'500);
  EXPECT_LE(early["known_ms"], early["now_ms"]);
  for (std::size_t i = 0; i < 20; ++i) {
    const double begin_ms = early["from_ms"].get<double>() + static_cast<double>(i) * 1'000.0;
    if (begin_ms > early["known_ms"]) {
      EXPECT_TRUE(early["series"][0]["last"][i].is_null()) << early.dump();
    }
  }
  const json late = json::parse(ask(target).text);
  EXPECT_EQ(late["known_ms"], late["now_ms"]);
  EXPECT_EQ(late["series"][0]["last"][9], 50.0);
  EXPECT_EQ(late["series"][0]["last"][10], 51.0);
}

// At a barrier, or while a simulated clock is held.
TEST_F(RecorderTest, WhenTheSameImageComesAgainAndAgain_ThenNothingIsMissing) {
  open();
  images_ = 1;
  look(0.0, {5}, 50.0);
  for (int i = 1; i < 50; ++i) {
    ++images_;
    again(0.1 * i);
  }
  ++images_;
  look(0.1, {5}, 50.0);
  const json levels = trend("points/a1.level", 0.0, 0.1, 10)["series"][0]["last"];
  for (int i = 0; i < 10; ++i) EXPECT_EQ(levels[i], 50.0) << i;
}

TEST_F(RecorderTest, WhenTheServerStartsAgain_ThenValuesAndAlarmsGoOnWhereTheyWere) {
  open();
  look(0.0, {5}, 50.0);
  look(1.0, {5}, 95.0);
  look(3.0, {6}, 96.0);
  EXPECT_EQ(answer("/api/alarms")["alarms"][0]["state"], "unacknowledged");
  ASSERT_TRUE(recorder_->alarms()
                  .command("a1.high", {.event = alarms::AlarmEvent::Acknowledge, .user = "anna"})
                  .has_value());
  open();
  const json alarms = answer("/api/alarms");
  ASSERT_EQ(alarms["alarms"].size(), 2u);
  EXPECT_EQ(alarms["alarms"][0]["name"], "server.away");
  EXPECT_EQ(alarms["alarms"][1]["name"], "a1.high");
  EXPECT_EQ(alarms["alarms"][1]["state"], "acknowledged");
  EXPECT_EQ(alarms["figures"]["in_ten_minutes"], 2);
  look(8.0, {6}, 40.0);
  EXPECT_TRUE(answer("/api/alarms")["alarms"].empty());
  const json entries = answer("/api/alarms/journal?alarm=a1.high")["entries"];
  EXPECT_EQ(entries[0]["time_ms"], kWall / 1'000'000 + 8'000) << "the clock is that of the same run";
  EXPECT_EQ(entries[1]["user"], "anna");
}

TEST_F(RecorderTest, WhenTheServerWasAway_ThenTheJournalTellsOfItAndOfWhatNobodySawHappen) {
  open();
  EXPECT_TRUE(answer("/api/alarms/journal")["entries"].empty()) << "before the first server there was none";
  look(0.0, {5}, 50.0);
  look(3.0, {5}, 50.0);
  open();
  look(10.0, {5}, 95.0);
  look(12.0, {5}, 95.0);
  look(13.0, {5}, 50.0);
  const json away = answer("/api/alarms/journal?alarm=server.away")["entries"];
  ASSERT_EQ(away.size(), 2u);
  EXPECT_EQ(away[1]["event"], "raise");
  EXPECT_EQ(away[1]["time_ms"], kWall / 1'000'000 + 3'000) << "when it looked last";
  EXPECT_EQ(away[0]["event"], "return");
  EXPECT_EQ(away[0]["to"], "normal") << "nobody has to acknowledge it";
  EXPECT_EQ(away[0]["time_ms"], kWall / 1'000'000 + 10'000);
  const json level = answer("/api/alarms/journal?alarm=a1.high")["entries"];
  ASSERT_EQ(level.size(), 2u);
  EXPECT_EQ(level[1]["event"], "raise");
  EXPECT_EQ(level[1]["comment"], "not seen since 2023-11-14T22:13:23.000Z");
  EXPECT_EQ(level[0]["comment"], "") << "the return was seen";
}

TEST_F(RecorderTest, WhenTheRuntimeWasAway_ThenWhatHasChangedMeanwhileWasNotSeenEither) {
  open();
  look(0.0, {5}, 50.0);
  look(4.0, {}, 0.0, false);
  look(9.0, {5}, 95.0);
  look(11.0, {5}, 95.0);
  const json level = answer("/api/alarms/journal?alarm=a1.high")["entries"];
  ASSERT_EQ(level.size(), 1u);
  EXPECT_EQ(level[0]["comment"], "not seen since 2023-11-14T22:13:24.000Z");
}

// The program keeps the scan.
TEST_F(RecorderTest, WhenAMonitorWasRaisedWhileTheServerWasAway_ThenItHasTheTimeOfItsScan) {
  open();
  look(1.0, {5, 100}, 50.0);
  look(2.0, {5, 200}, 50.0);
  open();
  look(6.0, {5, 600, 350}, 50.0);
  look(7.0, {5, 700, 350}, 50.0);
  const json raised = answer("/api/alarms/journal?alarm=plan.monitor.1")["entries"];
  ASSERT_EQ(raised.size(), 1u);
  EXPECT_EQ(raised[0]["time_ms"], kWall / 1'000'000 + 3'500);
  EXPECT_EQ(raised[0]["comment"], "");
}

TEST_F(RecorderTest, WhenMonitorsAreRaised_ThenTheirAlarmsHaveTheTimesOfTheirScansAndTheFirstIsFirst) {
  open();
  look(1.0, {0, 100}, 50.0);
  look(2.0, {0, 200, 0, 190, 180}, 50.0);  // 10 ms each
  const json alarms = answer("/api/alarms")["alarms"];
  ASSERT_EQ(alarms.size(), 2u);
  for (const json& alarm : alarms) {
    const bool third = alarm["name"] == "plan.monitor.3";
    EXPECT_EQ(alarm["raised_ms"], kWall / 1'000'000 + (third ? 1'800 : 1'900)) << alarm;
    EXPECT_EQ(alarm["first_out"], third) << alarm;
  }
  look(3.0, {0, 5, 0, 0, 0}, 50.0);  // the next program
  EXPECT_EQ(answer("/api/alarms")["alarms"][0]["state"], "returned, unacknowledged");
}

TEST_F(RecorderTest, WhenAlarmsChange_ThenPagesAreToldOnce) {
  open();
  const auto first = look(0.0, {}, 50.0);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(json::parse(*first)["type"], "alarms");
  EXPECT_FALSE(look(0.1, {}, 50.0).has_value());
  look(1.0, {}, 95.0);
  const auto news = look(2.5, {}, 95.0);
  ASSERT_TRUE(news.has_value());
  EXPECT_EQ(json::parse(*news)["alarms"][0]["raised_ms"], kWall / 1'000'000 + 2'000);
}

TEST_F(RecorderTest, WhenCommandsAreWrong_ThenTheyAreRefusedWithTheReason) {
  open();
  look(0.0, {}, 50.0);
  alarms::Command acknowledge{.event = alarms::AlarmEvent::Acknowledge, .user = "anna"};
  EXPECT_EQ(recorder_->alarms().command("none", acknowledge).error()[0].code, "C0607");
  EXPECT_EQ(recorder_->alarms().command("a1.high", acknowledge).error()[0].code, "C0606");
}

TEST_F(RecorderTest, WhenQueriesAreWrong_ThenEachIsRefusedWithACode) {
  open();
  look(0.0, {5}, 50.0);
  for (const char* target :
       {"/api/history/trend", "/api/history/trend?tags=none", "/api/history/trend?tags=plan.speed&columns=0",
        "/api/history/trend?tags=plan.speed&columns=4001", "/api/history/trend?tags=plan.speed&from_ms=nan",
        "/api/history/trend?tags=plan.speed&from_ms=1e300",
        "/api/history/trend?tags=plan.speed&from_ms=2&to_ms=1",
        "/api/history/trend?tags=plan.speed&to_ms=4500000000000&span_ms=-4500000000000",
        "/api/history/trend?tags=plan.speed&from_ms=-4600000000000", "/api/history/trend?tags=%FF",
        "/api/history/trend?tags=a;b;c;d", "/api/alarms/journal?state=odd", "/api/alarms/journal?most=501",
        "/api/alarms/journal?before=-1", "/api/alarms/journal?priority=%01",
        "/api/history/export.csv?tags=%zz"})
    EXPECT_EQ(answer(target, 400)["problems"][0]["code"], "H0060") << target;
  const json widest = answer(
      "/api/history/trend?tags=plan.speed&columns=4&from_ms=-4500000000000&to_ms=4500000000000")["series"][0];
  EXPECT_EQ(widest["last"].size(), 4u) << "the widest window is one like any other";
}

TEST_F(RecorderTest, WhenPeopleActOnAlarms_ThenStatesChangeAndTheJournalSaysWhoAndWhy) {
  open();
  look(0.0, {}, 50.0);
  look(1.0, {}, 95.0);
  look(3.0, {}, 95.0);
  RecordQueries records(*recorder_);
  const auto act = [&](const char* event, int minutes = 0) {
    const auto done = records.act({"a1.high", event, "anna", "is cleaned", std::chrono::minutes(minutes)});
    return done ? done->before + " -> " + done->after : done.error()[0].code;
  };
  EXPECT_EQ(act("acknowledge"), "unacknowledged -> acknowledged");
  EXPECT_EQ(act("acknowledge"), "C0606") << "there is nothing to acknowledge";
  EXPECT_EQ(act("shelve", 1), "acknowledged -> shelved");
  EXPECT_EQ(act("suppress"), "shelved -> suppressed by design");
  EXPECT_EQ(act("remove from service"), "suppressed by design -> out of service");
  EXPECT_EQ(act("return to service"), "out of service -> suppressed by design");
  EXPECT_EQ(act("unsuppress"), "suppressed by design -> shelved");
  look(64.0, {}, 95.0);
  EXPECT_EQ(answer("/api/alarms")["alarms"][0]["state"], "unacknowledged") << "the shelf's minute is over";
  EXPECT_EQ(act("unshelve"), "C0606");
  EXPECT_EQ(act("raise"), "C0606");
  EXPECT_EQ(act("explode"), "H0060");
  const json entries = answer("/api/alarms/journal")["entries"];
  EXPECT_EQ(entries[0]["event"], "unshelve");
  EXPECT_EQ(entries[0]["user"], "") << "by itself";
  EXPECT_EQ(entries[1]["event"], "unsuppress");
  EXPECT_EQ(entries[1]["user"], "anna");
  EXPECT_EQ(entries[1]["comment"], "is cleaned");
}

TEST_F(RecorderTest, WhenTheFolderCannotBeUsed_ThenTheErrorSaysWhy) {
  open();
  const auto second = CellRecorder::open(options_, [] { return kWall; });
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error()[0].code, "S0004");
  std::ofstream(folder_ / "file") << "x";
  options_.folder = folder_ / "file" / "below";
  EXPECT_EQ(CellRecorder::open(options_, [] { return kWall; }).error()[0].code, "S0001");
}

}  // namespace
}  // namespace stepwright::recorder

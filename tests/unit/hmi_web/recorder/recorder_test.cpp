#include <gtest/gtest.h>

#include <cstring>
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

// A level of a picture, an INT of the program, and the monitors of a plan.
class RecorderTest : public testing::Test {
 protected:
  RecorderTest() : layout_(std::make_shared<server::ProgramLayout>()) {
    options_.folder = folder_ / "history";
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
                                  bool alive = true) {
    wall_ns_ = kWall + static_cast<std::int64_t>(time_s * 1e9);
    server::Observation seen;
    seen.runtime_alive = alive;
    seen.layout = layout_;
    values.resize(5);
    std::vector<std::byte> image(20);
    std::memcpy(image.data(), values.data(), image.size());
    if (alive) seen.snapshot = server::ImageSnapshot{++scan_, time_s, image, {}};
    server::CellView view;
    view.layout = layout_;
    view.state.points = {level};
    for (const std::int32_t value : values) view.state.tags.push_back(value);
    return recorder_->take(seen, view);
  }
  // As the API's routes answer it.
  api::Answer ask(const std::string& target) {
    EXPECT_TRUE(recorder_->flush().has_value());
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
  std::uint64_t scan_ = 0;
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
  ASSERT_EQ(alarms["alarms"].size(), 1u);
  EXPECT_EQ(alarms["alarms"][0]["name"], "a1.high");
  EXPECT_EQ(alarms["alarms"][0]["state"], "acknowledged");
  EXPECT_EQ(alarms["figures"]["in_ten_minutes"], 1);
  look(8.0, {6}, 40.0);
  EXPECT_TRUE(answer("/api/alarms")["alarms"].empty());
  EXPECT_EQ(answer("/api/alarms/journal")["entries"][0]["time_ms"], kWall / 1'000'000 + 8'000)
      << "the clock is that of the same run";
  EXPECT_EQ(answer("/api/alarms/journal")["entries"][1]["user"], "anna");
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

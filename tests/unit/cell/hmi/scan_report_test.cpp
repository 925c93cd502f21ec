#include "cell/hmi/scan_report.h"

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

namespace stepwright::hmi {
namespace {

using nlohmann::json;

FollowedRuntime running() {
  host::RuntimeStatus status;
  status.state = host::RuntimeState::Running;
  status.program_digest = "ab12";
  status.process = {"0.1.0", 61.5, 4'096, 2, 1, 0, 0};
  status.tasks = {{"fast", 10'000, 0, 500, 3, 1, {1, 2, 3, 4, 5}, {6, 7, 8, 9, 10}, {0, 1, 1, 2, 3}},
                  {"slow", 0, 1, 5, 0, 0, {}, {}, {}}};
  FollowedRuntime runtime{.runtime = "bench", .own = true, .alive = true, .status = status};
  runtime.health.emplace();
  runtime.health->tasks = {{"fast", 5'000, 3, 2, 1, {}, {10, {4, 0, 6}}, {}}};
  return runtime;
}

json report(const FollowedRuntime& runtime) {
  return json::parse(scan_report(std::array{runtime}))["runtimes"][0];
}

TEST(ScanReport, WhenATaskHasAHistogram_ThenItsBucketsFollowEachOtherWithTheirCounts) {
  const json said = report(running());
  const json execution = said["tasks"][0]["execution"];
  EXPECT_EQ(execution["p999_us"], 8.0);
  EXPECT_EQ(execution["max_us"], 10.0);
  const json buckets = execution["buckets"];
  ASSERT_EQ(buckets.size(), 3u);
  EXPECT_EQ(buckets[0][2], 4);
  EXPECT_EQ(buckets[2][2], 6);
  EXPECT_EQ(buckets[0][1], buckets[1][0]) << "no gap";
  EXPECT_LT(buckets[0][0].get<double>(), buckets[0][1].get<double>());
  EXPECT_EQ(said["tasks"][0]["watchdog"],
            (json{{"limit_us", 5'000}, {"sensitivity", 3}, {"too_long", 2}, {"expiries", 1}}));
}

TEST(ScanReport, WhenALinkDoesNotPublishHealth_ThenWhatIsMissingIsNull) {
  FollowedRuntime old = running();
  old.health.reset();
  const json said = report(old);
  EXPECT_TRUE(said["tasks"][0]["execution"]["buckets"].is_null());
  EXPECT_EQ(said["tasks"][0]["execution"]["p50_us"], 6.0) << "of the status";
  EXPECT_TRUE(said["tasks"][0]["watchdog"].is_null());
  EXPECT_TRUE(said["io"].is_null());
  EXPECT_TRUE(said["followers"].is_null());
}

TEST(ScanReport, WhenHealthIsOfAnotherProgram_ThenATaskIsNotMistakenForAnother) {
  const json said = report(running());
  EXPECT_EQ(said["tasks"][1]["name"], "slow");
  EXPECT_TRUE(said["tasks"][1]["execution"]["buckets"].is_null());
}

TEST(ScanReport, WhenARuntimeWasNeverHeardOf_ThenItIsThereWithoutFigures) {
  const json said = report({.runtime = "press", .own = false, .alive = false});
  EXPECT_EQ(said["runtime"], "press");
  EXPECT_EQ(said["alive"], false);
  EXPECT_EQ(said["state"], "");
  EXPECT_TRUE(said["process"].is_null());
  EXPECT_TRUE(said["scan"].is_null());
  EXPECT_EQ(said["tasks"], json::array());
}

TEST(ScanReport, WhenDevicesAndTopicsAreKnown_ThenTheyAreTold) {
  FollowedRuntime runtime = running();
  runtime.health->io = dds::IoKind::Modbus;
  runtime.health->devices_known = true;
  runtime.health->devices = {
      {"valves", "10.0.0.2:502", 7, true, false, "", 100, 2, 0, 0, 1, 1.5, 2.5, 3.5, 40},
      {"pumps", "10.0.0.3:502", 8, false, true, "timed out", 9, 9, 0, 0, 1, 0, 0, 0, -1}};
  runtime.traffic = {{"stepwright/status/3", 1, 50, 0, 2, 0.05}, {"stepwright/event/3", 0, 0, 0, 0, -1.0}};
  const json said = report(runtime);
  EXPECT_EQ(said["io"]["kind"], "modbus");
  EXPECT_EQ(said["io"]["devices"][0]["answer_age_ms"], 40);
  EXPECT_TRUE(said["io"]["devices"][1]["answer_age_ms"].is_null());
  EXPECT_EQ(said["io"]["devices"][1]["error"], "timed out");
  EXPECT_EQ(said["dds"][0]["lost"], 2);
  EXPECT_TRUE(said["dds"][1]["age_s"].is_null());
}

TEST(ScanReport, WhenNothingStandsBehindTheInputs_ThenNoPlantIsSpokenOf) {
  FollowedRuntime runtime = running();
  runtime.health->io = dds::IoKind::Nothing;
  EXPECT_EQ(report(runtime)["io"]["kind"], "nothing");
}

TEST(ScanReport, WhenATextIsNoUtf8_ThenTheRestStillArrives) {
  FollowedRuntime runtime = running();
  runtime.status->detail = "a\xFFz";
  EXPECT_EQ(report(runtime)["runtime"], "bench");
}

}  // namespace
}  // namespace stepwright::hmi

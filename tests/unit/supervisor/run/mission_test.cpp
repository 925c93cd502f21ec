// What every mission has of the run: programs that come to run, news, incidents, the end.

#include "supervisor/run/mission.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/support/controller/simulated_controller.h"
#include "tests/unit/supervisor/run/asked.h"
#include "tests/unit/supervisor/run/filling_mission.h"

namespace stepwright::run {
namespace {

using filling::FillingMission;

constexpr int kCounts = 2'500;

class MissionTest : public testing::Test {
 protected:
  RunRecord run(FillingMission& mission) {
    RunRecord record = mission.run();
    EXPECT_FALSE(controller_.any_output());
    return record;
  }

  support::SimulatedController controller_{assemblies::BenchParameters{}};
};

TEST_F(MissionTest, WhenThePlanEnds_ThenTheGoalIsReachedAndTheRuntimeStopped) {
  std::vector<Phase> phases;
  FillingMission mission(controller_, {.cell = "bench"}, kCounts, [&](const RunRecord& record) {
    if (phases.empty() || phases.back() != record.phase) phases.push_back(record.phase);
  });
  const RunRecord record = run(mission);
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_GE(record.observed.at("level"), kCounts);
  EXPECT_EQ(phases, (std::vector{Phase::Planning, Phase::Executing, Phase::Done}));
  EXPECT_TRUE(record.incidents.empty());
  EXPECT_EQ(controller_.stops(), 1);
  ASSERT_EQ(record.episodes.size(), 1u);
  EXPECT_GT(*record.episodes[0].actions[0].finished_s, record.episodes[0].started_s);
}

TEST_F(MissionTest, WhenTheRuntimeIsLost_ThenItIsPlannedForAnewAndTheClockGoesOn) {
  controller_.kill_runtime_at(2.0);
  FillingMission mission(controller_, {.cell = "bench"}, kCounts);
  const RunRecord record = run(mission);
  EXPECT_EQ(record.phase, Phase::Done);
  ASSERT_EQ(record.incidents.size(), 1u);
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::LostRuntime);
  EXPECT_EQ(record.incidents[0].response, Response::Replan);
  ASSERT_EQ(record.episodes.size(), 2u);
  EXPECT_GE(record.episodes[1].started_s, record.episodes[0].started_s);
}

TEST_F(MissionTest, WhenItIsAborted_ThenTheOutputsAreSafeAndTheReasonIsTold) {
  FillingMission* running = nullptr;
  FillingMission mission(controller_, {.cell = "bench"}, kCounts, [&](const RunRecord& record) {
    if (record.phase == Phase::Executing) running->request_abort();
  });
  running = &mission;
  const RunRecord record = run(mission);
  EXPECT_EQ(record.phase, Phase::Safe);
  EXPECT_EQ(record.message, "aborted by the operator");
  EXPECT_EQ(record.exit, result::ExitCode::RuntimeFault);
  ASSERT_EQ(record.incidents.size(), 1u);
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::Operator);
  EXPECT_EQ(record.incidents[0].response, Response::SafeStop);
  EXPECT_EQ(controller_.stops(), 1);
}

TEST_F(MissionTest, WhenPeopleWantSomethingElse_ThenThatIsPlannedForWithoutAStop) {
  FillingMission* running = nullptr;
  bool asked = false;
  FillingMission mission(controller_, {.cell = "bench"}, kCounts, [&](const RunRecord& record) {
    if (record.phase != Phase::Executing || std::exchange(asked, true)) return;
    EXPECT_TRUE(ask(*running, R"_({"request": "change", "fluent": "(level v1)", "value": 3000})_"));
  });
  running = &mission;
  const RunRecord record = run(mission);
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_GE(record.observed.at("level"), 3'000);
  ASSERT_EQ(record.replans.size(), 1u);
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::NewGoal);
  EXPECT_EQ(controller_.changes(), 1);
  EXPECT_EQ(controller_.stops(), 1) << "at the end";
}

TEST_F(MissionTest, WhenARequestCannotBeMeantOrNotNow_ThenTheCodeTells) {
  FillingMission mission(controller_, {.cell = "bench"}, kCounts);
  const auto code = [&](const char* text) { return refusal(mission, text); };
  EXPECT_EQ(code(R"_({"request": "order"})_"), "X0003");
  EXPECT_EQ(code(R"_({"request": "change", "fluent": "(level v1)", "value": "full"})_"), "X0005");
  EXPECT_FALSE(mission.over());
  (void)run(mission);
  EXPECT_TRUE(mission.over());
  EXPECT_EQ(code(R"_({"request": "change", "fluent": "(level v1)", "value": 2500})_"), "X0008");
  EXPECT_EQ(code(R"_({"request": "abort"})_"), "X0008");
  EXPECT_EQ(code(R"_({"request": "start"})_"), "X0008") << "there is no other run to start";
  EXPECT_FALSE(mission.wait_start(std::chrono::milliseconds(0)));
}

TEST_F(MissionTest, WhenAnOperatorStartsRuns_ThenNothingMovesBeforeThatAndWhatIsWantedMeanwhileCounts) {
  FillingMission* waiting = nullptr;
  FillingMission mission(
      controller_, {.cell = "bench", .operator_starts = true}, kCounts, [&](const RunRecord& record) {
        if (record.phase != Phase::Ready) return;
        EXPECT_FALSE(controller_.any_output());
        EXPECT_TRUE(ask(*waiting, R"_({"request": "change", "fluent": "(level v1)", "value": 3000})_"));
        EXPECT_TRUE(ask(*waiting, R"_({"request": "start"})_"));
        EXPECT_EQ(ask(*waiting, R"_({"request": "start"})_").error()[0].code, "X0008");
      });
  waiting = &mission;
  EXPECT_EQ(ask(mission, R"_({"request": "start"})_").error()[0].code, "X0008") << "there is no plan yet";
  const RunRecord record = run(mission);
  EXPECT_EQ(record.phase, Phase::Done);
  EXPECT_GE(record.observed.at("level"), 3'000);
  EXPECT_EQ(record.episodes.size(), 1u);
}

TEST_F(MissionTest, WhenAMissionSaysNothingOfGoals_ThenThePageIsToldThatThereAreNone) {
  const FillingMission mission(controller_, {.cell = "bench"}, kCounts);
  EXPECT_NE(mission.goal_form().find("\"available\":false"), std::string::npos);
}

TEST_F(MissionTest, WhenSomebodyStopsTheRuntime_ThenTheRunEndsAndDoesNotGoOnByItself) {
  FillingMission mission(controller_, {.cell = "bench"}, kCounts, [&](const RunRecord& record) {
    if (record.phase == Phase::Executing) (void)controller_.stop("by hand");
  });
  const RunRecord record = run(mission);
  EXPECT_EQ(record.phase, Phase::Safe);
  EXPECT_EQ(record.message, "stopped from outside: by hand");
}

TEST_F(MissionTest, WhenAWatchedTagBecomesTrue_ThenThatIsAnIncidentAndAPlanIsMadeAnew) {
  FillingMission* running = nullptr;
  FillingMission mission(controller_, {.cell = "bench"}, kCounts, [&](const RunRecord& record) {
    if (record.phase == Phase::Replanning) running->request_abort();
  });
  running = &mission;
  mission.watch({{"filling.Done_X", "monitor 'never_full' failed: never full"}});
  const RunRecord record = run(mission);
  EXPECT_EQ(record.phase, Phase::Safe);
  ASSERT_GE(record.incidents.size(), 1u);
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::Monitor);
  EXPECT_STREQ(to_string(record.incidents[0].kind), "monitor");
  EXPECT_EQ(record.incidents[0].evidence.front(), "monitor 'never_full' failed: never full");
  EXPECT_EQ(record.incidents[0].response, Response::Replan);
}

}  // namespace
}  // namespace stepwright::run

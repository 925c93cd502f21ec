// A train's run with its real planner, compiler, scan and plant.

#include "supervisor/ltl/mission/train_mission.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "supervisor/ltl/mission/train_journal.h"
#include "tests/unit/supervisor/ltl/mission/train_hall.h"
#include "tests/unit/supervisor/run/asked.h"

namespace stepwright::ltl {
namespace {

using run::IncidentKind;
using run::Phase;
using testing::story;
using testing::TrainHall;

void expect_done(const TrainHall& hall, const run::RunRecord& record) {
  ASSERT_EQ(record.phase, Phase::Done) << story(record);
  EXPECT_TRUE(record.goal.front().met);
  EXPECT_EQ(hall.truth("contacts"), 0.0);
  EXPECT_GT(hall.truth("smallest_gap"), 0.0);
  for (const run::ActionRecord& action : record.episodes.back().actions)
    EXPECT_EQ(action.state, run::ActionState::Done) << action.text;
}

TEST(TrainMission, WhenATaskIsDriven_ThenItsMonitorSaysDoneAndNothingWasMet) {
  TrainHall hall("visit press then visit rack, press before wash", 3);
  std::vector<Phase> phases;
  const run::RunRecord record = hall.run(hall.options(), [&](const run::RunRecord& now) {
    if (phases.empty() || phases.back() != now.phase) phases.push_back(now.phase);
  });
  expect_done(hall, record);
  EXPECT_EQ(phases, (std::vector{Phase::Planning, Phase::Executing, Phase::Done}));
  EXPECT_TRUE(record.incidents.empty()) << story(record);
  ASSERT_EQ(record.episodes.size(), 1u);
  const auto& actions = record.episodes[0].actions;
  ASSERT_EQ(actions.size(), 3u);
  EXPECT_EQ(actions[0].text, "(reach press)");
  EXPECT_EQ(actions[1].text, "(reach rack)");
  EXPECT_NEAR(*actions[1].finished_s - record.started_s, actions[1].planned_finish_s,
              0.15 * actions[1].planned_finish_s + 2.0);
  EXPECT_FALSE(hall.controller().any_output());
}

TEST(TrainMission, WhenTheSameIsRunTwice_ThenItIsTheSameRun) {
  TrainHall first("visit press", 2), second("visit press", 2);
  const run::RunRecord a = first.run(first.options()), b = second.run(second.options());
  expect_done(first, a);
  EXPECT_EQ(a.finished_s, b.finished_s);
  EXPECT_EQ(first.truth("true_x"), second.truth("true_x"));
  EXPECT_EQ(first.truth("true_heading"), second.truth("true_heading"));
}

TEST(TrainMission, WhenSomethingStandsInTheWay_ThenTheTrainPlansRoundItFromRest) {
  TrainHall hall("visit rack then visit press", 2, {{2.0, "block_2", 1.0}});
  const run::RunRecord record = hall.run(hall.options());
  expect_done(hall, record);
  ASSERT_FALSE(record.incidents.empty());
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::Position);
  EXPECT_EQ(record.incidents[0].evidence.front().substr(0, 27), "something stands in the way")
      << story(record);
  EXPECT_GE(record.episodes.size(), 2u);
}

TEST(TrainMission, WhenSomebodyWantsAnotherTask_ThenItIsPlannedForFromWhereTheTrainIs) {
  TrainHall hall("visit press", 2);
  TrainMissionOptions options = hall.options();
  options.requests = {{4.0, GoalChange{"visit rack"}}};
  const run::RunRecord record = hall.run(options);
  expect_done(hall, record);
  EXPECT_EQ(record.goal.front().text, "visit rack");
  ASSERT_EQ(record.replans.size(), 1u) << story(record);
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::NewGoal);
  EXPECT_EQ(hall.controller().stops(), 1) << "at the end";
  EXPECT_GT(hall.truth("true_x"), 21.0);
  EXPECT_LT(hall.truth("true_y"), 7.0);
}

TEST(TrainMission, WhenHalfOfTheTaskIsDone_ThenTheNewPlanDoesTheRest) {
  TrainHall hall("visit rack then visit press", 1);
  TrainMissionOptions options = hall.options();
  bool asked = false;
  TrainMission* running = nullptr;
  TrainMission mission(hall.planning(), hall.controller(), options, [&](const run::RunRecord& record) {
    if (record.episodes.empty() || asked) return;
    if (record.episodes[0].actions[0].state != run::ActionState::Done) return;
    asked = true;
    EXPECT_TRUE(running->request(BlockChange{
        {.name = "crate", .ring = {{1.0, 8.0}, {3.0, 8.0}, {3.0, 10.0}, {1.0, 10.0}}, .where = {}}}));
  });
  running = &mission;
  const run::RunRecord record = mission.run();
  expect_done(hall, record);
  ASSERT_EQ(record.episodes.size(), 2u) << story(record);
  EXPECT_EQ(record.episodes[1].actions.size(), 2u) << "the press, and to a halt";
  EXPECT_EQ(record.episodes[1].actions[0].text, "(reach press)");
}

TEST(TrainMission, WhenATrailerIsLeft_ThenTheOthersGoOnWithoutIt) {
  TrainHall hall("visit press", 3, {{5.0, "leave_trailers", 1.0}});
  const run::RunRecord record = hall.run(hall.options());
  expect_done(hall, record);
  EXPECT_EQ(hall.truth("true_trailers"), 1.0);
  ASSERT_FALSE(record.incidents.empty());
  EXPECT_EQ(record.incidents[0].evidence.front(), "1 trailers are coupled, the plan has 3");
}

TEST(TrainMission, WhenAPlaceIsOutOfServiceAndNobodyIsThere_ThenTheRunEndsWithTheReason) {
  TrainHall hall("visit press", 1);
  TrainMissionOptions options = hall.options();
  options.requests = {{2.0, BlockChange{hall.planning().options().problem.floor.propositions[0]}}};
  const run::RunRecord record = hall.run(options);
  EXPECT_EQ(record.phase, Phase::Safe);
  EXPECT_NE(record.message.find("cannot be done without 'press'"), std::string::npos) << record.message;
  EXPECT_EQ(hall.truth("contacts"), 0.0);
}

TEST(TrainMission, WhenAPlaceIsOutOfServiceForAWhile_ThenTheTrainWaitsAndGoesOn) {
  TrainHall hall("visit press", 1);
  TrainMissionOptions options = hall.options();
  options.attended = true;
  options.requests = {{2.0, BlockChange{hall.planning().options().problem.floor.propositions[0]}},
                      {20.0, UnblockChange{"press"}},
                      {20.0, ResumeChange{}}};
  expect_done(hall, hall.run(options));
}

TEST(TrainMission, WhenTheEmergencyStopIsPressed_ThenTheTrainStandsUntilPeopleLetItGoOn) {
  TrainHall hall("visit press", 2, {{4.0, "press_estop", 1.0}, {8.0, "press_estop", 0.0, true}});
  TrainMissionOptions options = hall.options();
  options.attended = true;
  options.requests = {{6.0, ResumeChange{}}, {12.0, ResumeChange{}}};
  const run::RunRecord record = hall.run(options);
  expect_done(hall, record);
  EXPECT_GE(record.finished_s, 12.0);
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::Operator) << story(record);
}

TEST(TrainMission, WhenTheRuntimeIsLost_ThenTheRunGoesOnFromWhereTheTrainStands) {
  TrainHall hall("visit rack then visit press", 2);
  hall.controller().kill_runtime_at(9.0);
  const run::RunRecord record = hall.run(hall.options());
  expect_done(hall, record);
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::LostRuntime) << story(record);
}

TEST(TrainMission, WhenTheSupervisorIsRestarted_ThenTheRestOfTheTaskIsDone) {
  TrainHall hall("visit rack then visit press", 1);
  TrainMissionOptions options = hall.options();
  options.journal = hall.journal();
  struct Killed {};
  try {
    hall.run(options, [&](const run::RunRecord& record) {
      if (!record.episodes.empty() && record.episodes[0].actions[0].state == run::ActionState::Done &&
          record.phase == Phase::Executing)
        throw Killed{};
    });
    FAIL() << "it ended before it was killed";
  } catch (const Killed&) {
  }
  const run::RunRecord record = hall.run(options);
  expect_done(hall, record);
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::LostSupervisor) << story(record);
  EXPECT_EQ(record.episodes.back().actions[0].text, "(reach press)") << "the rack was visited";
}

TEST(TrainMission, WhenAnotherTaskComesBehindHalfOfTheFirst_ThenItIsDoneFromItsBeginning) {
  TrainHall hall("visit rack then visit press", 0);
  TrainMissionOptions options = hall.options();
  bool asked = false;
  TrainMission* running = nullptr;
  TrainMission mission(hall.planning(), hall.controller(), options, [&](const run::RunRecord& record) {
    if (record.episodes.empty() || asked) return;
    if (record.episodes[0].actions[0].state != run::ActionState::Done) return;
    asked = true;
    EXPECT_TRUE(running->request(GoalChange{"visit wash"}));
  });
  running = &mission;
  const run::RunRecord record = mission.run();
  expect_done(hall, record);
  ASSERT_EQ(record.episodes.size(), 2u) << story(record);
  EXPECT_EQ(record.episodes[1].actions[0].text, "(reach wash)");
  EXPECT_LT(hall.truth("true_x"), 9.0);
  EXPECT_GT(hall.truth("true_y"), 13.0);
}

TEST(TrainMission, WhenAStartBringsATask_ThenThatOneIsPlannedFromTheBeginning) {
  TrainHall hall("visit press", 0);
  TrainMissionOptions options = hall.options();
  options.operator_starts = true;
  TrainMission* running = nullptr;
  bool drawn = false;
  TrainMission mission(hall.planning(), hall.controller(), options, [&](const run::RunRecord& record) {
    if (record.phase != Phase::Ready) return;
    drawn |= running->new_pictures().has_value();
    EXPECT_EQ(run::refusal(*running, R"({"request": "start", "goal": "visit pres"})"), "L0311");
    EXPECT_EQ(run::refusal(*running, R"({"request": "start", "goal": 3})"), "X0005");
    EXPECT_EQ(run::refusal(*running, R"({"request": "start", "goal": "visit rack"})"), "");
  });
  running = &mission;
  const run::RunRecord record = mission.run();
  expect_done(hall, record);
  EXPECT_EQ(record.goal.front().text, "visit rack");
  EXPECT_TRUE(record.replans.empty()) << story(record);
  ASSERT_EQ(record.episodes.size(), 1u);
  EXPECT_TRUE(drawn) << "the floor is shown before anything moves";
  const auto pictures = mission.new_pictures();
  ASSERT_TRUE(pictures);
  EXPECT_NE(pictures->find(record.episodes[0].digest), std::string::npos);
  EXPECT_FALSE(mission.new_pictures()) << "they are told once";

  // Another run begins with its start, and with the task that came with it.
  ASSERT_EQ(run::refusal(mission, R"({"request": "start", "goal": "visit press"})"), "");
  ASSERT_TRUE(mission.wait_start(std::chrono::milliseconds(0)));
  const run::RunRecord again = mission.run();
  EXPECT_EQ(again.phase, Phase::Done) << story(again);
  EXPECT_EQ(again.goal.front().text, "visit press");
}

TEST(TrainMission, WhenARunWasAborted_ThenAStartBeginsAnotherOne) {
  TrainHall hall("visit press", 0);
  TrainMissionOptions options = hall.options();
  options.journal = hall.journal();
  TrainMission* running = nullptr;
  bool aborts = true;
  TrainMission mission(hall.planning(), hall.controller(), options, [&](const run::RunRecord& record) {
    if (record.phase == Phase::Executing && std::exchange(aborts, false)) running->request_abort();
  });
  running = &mission;
  const run::RunRecord aborted = mission.run();
  ASSERT_EQ(aborted.phase, Phase::Safe) << story(aborted);
  ASSERT_EQ(run::refusal(mission, R"({"request": "start"})"), "");
  ASSERT_TRUE(mission.wait_start(std::chrono::milliseconds(0)));
  const run::RunRecord record = mission.run();
  expect_done(hall, record);
  EXPECT_EQ(record.exit, result::ExitCode::Done);
  EXPECT_EQ(record.episodes.size(), 1u) << "nothing is kept of the run before";
  EXPECT_TRUE(record.incidents.empty()) << story(record);
  EXPECT_GE(record.started_s, aborted.started_s);
}

TEST(TrainMission, WhenASupervisorRunsOnce_ThenAStartAfterItsRunIsRefused) {
  TrainHall hall("visit press", 0);
  TrainMission mission(hall.planning(), hall.controller(), hall.options(), {});
  mission.only_once();
  mission.request_abort();
  EXPECT_EQ(mission.run().phase, Phase::Safe);
  EXPECT_EQ(run::refusal(mission, R"({"request": "start"})"), "X0008");
}

TEST(TrainMission, WhenRequestsMeanNothing_ThenTheyAreRefusedAtOnce) {
  TrainHall hall("visit press", 0);
  TrainMission mission(hall.planning(), hall.controller(), hall.options(), {});
  const auto code = [&](const char* text) { return run::refusal(mission, text); };
  EXPECT_NE(mission.goal_form().find("for example: visit press then visit rack"), std::string::npos);
  EXPECT_EQ(code(R"({"request": "goal", "goal": "visit pres"})"), "L0311");
  EXPECT_EQ(code(R"({"request": "goal"})"), "X0005");
  EXPECT_EQ(code(R"({"request": "order", "name": "x"})"), "X0003");
  EXPECT_EQ(code(R"({"request": "block", "name": "crate"})"), "X0005");
  EXPECT_EQ(code(R"({"request": "block", "name": "press"})"), "");
  EXPECT_EQ(code(R"({"request": "block", "name": "c", "corners_m": [[1, 1], [2, 1], [2, 2]]})"), "");
  EXPECT_EQ(code(R"({"request": "block", "name": "c", "corners_m": [[1, 1], [2, 1]]})"), "X0005");
  EXPECT_EQ(code(R"({"request": "block", "name": "c", "corners_m": 4})"), "X0005");
  const auto area = [&](const char* corners) {
    return code((std::string(R"({"request": "block", "name": "c", "corners_m": )") + corners + "}").c_str());
  };
  EXPECT_EQ(area("[[30, 4], [1e9, 5], [1e9, 3]]"), "L0202");
  EXPECT_EQ(area("[[1e300, 2], [1e301, 3], [4, 5]]"), "L0202");
  EXPECT_EQ(area("[[25, 2], [29, 2], [25, 6], [29, 6]]"), "L0203") << "it crosses itself";
  EXPECT_EQ(area("[[25, 2], [26, 2], [27, 2]]"), "L0203") << "it has no area";
  EXPECT_EQ(area("[[25, 2], [25, 2], [25, 2]]"), "L0203") << "it is a point";
  EXPECT_EQ(area("[[25, 2], [29, 2], [29, 6], [25, 6]]"), "");
  const auto both =
      run::ask(mission, R"({"request": "block", "name": "press", "corners_m": [[1, 1], [2, 1], [2, 2]]})");
  ASSERT_FALSE(both) << "an area that would be ignored";
  EXPECT_EQ(both.error().front().message, "'press' is a place of the floor, which is blocked as a whole");
}

}  // namespace
}  // namespace stepwright::ltl

// A run of two arms with its real planner, compiler, scan and plant.

#include "supervisor/tamp/mission/arms_mission.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "supervisor/tamp/mission/arms_journal.h"
#include "tests/unit/supervisor/run/asked.h"
#include "tests/unit/supervisor/tamp/mission/arms_cell.h"

namespace stepwright::tamp::mission {
namespace {

using run::IncidentKind;
using run::Phase;
using testing::ArmsCell;
using testing::story;

constexpr const char* kUp = "(in cup1 box-top)";

void expect_on_the_box(const ArmsCell& cell) {
  EXPECT_NEAR(cell.truth("z_cup1"), 0.85, 0.001);
  EXPECT_NEAR(cell.truth("x_cup1"), 0.45, 0.1);
  EXPECT_NEAR(cell.truth("y_cup1"), 0.0, 0.12);
}

void expect_done(const ArmsCell& cell, const run::RunRecord& record) {
  ASSERT_EQ(record.phase, Phase::Done) << story(record);
  for (const run::GoalRecord& each : record.goal) EXPECT_TRUE(each.met) << each.text;
  for (const run::ActionRecord& action : record.episodes.back().actions)
    EXPECT_EQ(action.state, run::ActionState::Done) << action.text;
  EXPECT_EQ(cell.truth("held_left") + cell.truth("held_right"), 0.0);
}

bool tells(const run::RunRecord& record, const std::string& words) {
  for (const run::Incident& each : record.incidents)
    if (run::sentence_of(each.evidence).find(words) != std::string::npos) return true;
  return record.message.find(words) != std::string::npos;
}

TEST(ArmsMission, WhenAnOrderIsWorkedOn_ThenItIsDoneWithoutAContactAndTheArmsAreHome) {
  ArmsCell cell("(in cup1 red-region)");
  std::vector<Phase> phases;
  const run::RunRecord record = cell.run(cell.options(), [&](const run::RunRecord& now) {
    if (phases.empty() || phases.back() != now.phase) phases.push_back(now.phase);
  });
  expect_done(cell, record);
  EXPECT_EQ(phases, (std::vector{Phase::Planning, Phase::Executing, Phase::Observing, Phase::Done}));
  EXPECT_TRUE(record.incidents.empty()) << story(record);
  EXPECT_EQ(cell.contacts(), 0.0);
  ASSERT_EQ(record.episodes.size(), 1u);
  const auto& actions = record.episodes[0].actions;
  ASSERT_GE(actions.size(), 5u);
  EXPECT_EQ(actions[0].text, "right picks cup1");
  for (const run::ActionRecord& each : actions) {
    EXPECT_LT(each.planned_start_s, each.planned_finish_s) << each.text;
    EXPECT_LT(*each.started_s, *each.finished_s) << each.text;
  }
  EXPECT_FALSE(cell.controller().any_output());
  const auto& home = cell.planning().cell().arms[1].home;
  EXPECT_NEAR(cell.truth("true_right_2"), home[1], 0.01);
}

TEST(ArmsMission, WhenTheSameIsRunTwice_ThenItIsTheSameRun) {
  ArmsCell first(kUp), second(kUp);
  const run::RunRecord a = first.run(first.options()), b = second.run(second.options());
  expect_done(first, a);
  expect_on_the_box(first);
  EXPECT_EQ(a.finished_s, b.finished_s);
  EXPECT_EQ(first.truth("x_cup1"), second.truth("x_cup1"));
  EXPECT_EQ(first.truth("true_right_1"), second.truth("true_right_1"));
}

TEST(ArmsMission, WhenAThingFallsOutOfAHand_ThenItIsPickedUpAgain) {
  ArmsCell cell(kUp, {{6.6, "drop_right", 1.0}, {8.1, "drop_right", 0.0, true}});
  const run::RunRecord record = cell.run(cell.options());
  expect_done(cell, record);
  expect_on_the_box(cell);
  EXPECT_TRUE(tells(record, "cup1")) << story(record);
  EXPECT_GE(record.episodes.size(), 2u) << story(record);
  EXPECT_EQ(cell.truth("contacts_arm_arm") + cell.truth("contacts_arm_fixed"), 0.0);
}

TEST(ArmsMission, WhenAThingIsMovedMeanwhile_ThenItIsSeenAndPlannedForWhereItIs) {
  ArmsCell cell(kUp, {{1.6, "shift_y_cup1", 100.0}});
  const run::RunRecord record = cell.run(cell.options());
  expect_done(cell, record);
  expect_on_the_box(cell);
  EXPECT_TRUE(tells(record, "cup1 was moved")) << story(record);
  EXPECT_EQ(cell.contacts(), 0.0);
}

TEST(ArmsMission, WhenAThingSlipsAgainAndAgain_ThenTheRunEndsSafeWithTheCause) {
  ArmsCell cell(kUp, {{1.0, "drop_right", 1.0}});
  ArmsMissionOptions options = cell.options();
  options.retries = 1;
  const run::RunRecord record = cell.run(options);
  EXPECT_EQ(record.phase, Phase::Safe) << story(record);
  EXPECT_NE(record.message.find("the right hand has closed and does not hold cup1"), std::string::npos)
      << story(record);
  double last_s = record.started_s;
  for (const run::Episode& episode : record.episodes)
    for (const run::ActionRecord& each : episode.actions)
      last_s = std::max(last_s, each.finished_s.value_or(0.0));
  EXPECT_EQ(record.finished_s, last_s) << "the last action that ended, or none";
  EXPECT_FALSE(cell.controller().any_output());
}

TEST(ArmsMission, WhenTheEmergencyStopIsPressed_ThenTheArmsStandUntilPeopleLetThemGoOn) {
  ArmsCell cell(kUp, {{6.5, "press_estop", 1.0}, {9.0, "press_estop", 0.0, true}});
  ArmsMissionOptions options = cell.options();
  options.attended = true;
  options.requests = {{8.0, ResumeChange{}}, {11.0, ResumeChange{}}};
  const run::RunRecord record = cell.run(options);
  expect_done(cell, record);
  expect_on_the_box(cell);
  EXPECT_GE(record.finished_s, 11.0);
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::Operator) << story(record);
  EXPECT_TRUE(tells(record, "still pressed")) << story(record);
}

TEST(ArmsMission, WhenSomebodyWantsSomethingElse_ThenWhatIsHeldIsTakenThere) {
  ArmsCell cell("(in cup1 red-region)");
  ArmsMissionOptions options = cell.options();
  options.requests = {{7.0, GoalChange{kUp}}};
  const run::RunRecord record = cell.run(options);
  expect_done(cell, record);
  expect_on_the_box(cell);
  ASSERT_EQ(record.replans.size(), 1u) << story(record);
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::NewGoal);
  EXPECT_EQ(cell.controller().stops(), 1) << "at the end";
  EXPECT_EQ(cell.contacts(), 0.0);
}

TEST(ArmsMission, WhenAJointIsStuck_ThenTheRunEndsSafeAndSaysWhichOne) {
  ArmsCell cell(kUp, {{3.2, "stuck_right_1", 1.0}});
  const run::RunRecord record = cell.run(cell.options());
  EXPECT_EQ(record.phase, Phase::Safe) << story(record);
  EXPECT_NE(record.message.find("joint 1 of the right arm does not move"), std::string::npos)
      << record.message;
  EXPECT_EQ(cell.contacts(), 0.0);
}

// Where drives may lag that much, nothing stops the arm, and it is not at home.
TEST(ArmsMission, WhenAJointSticksJustBeforeTheEnd_ThenTheRunEndsWithThatJoint) {
  constexpr double kLoose_rad = 0.25;
  ArmsCell first(kUp, {}, 1, {}, kLoose_rad);
  const double home_rad = first.planning().cell().arms[1].home[1];
  double at_s = 0.0;
  first.controller().on_scan = [&](std::span<const std::byte>) {
    if (std::abs(first.truth("true_right_2") - home_rad) > 0.05) at_s = first.controller().now_s();
  };
  expect_done(first, first.run(first.options()));
  ArmsCell cell(kUp, {{at_s, "stuck_right_2", 1.0}}, 1, {}, kLoose_rad);
  const run::RunRecord record = cell.run(cell.options());
  EXPECT_EQ(record.phase, Phase::Safe) << story(record);
  EXPECT_NE(record.message.find("joint 2 of the right arm is 0.0"), std::string::npos) << record.message;
  EXPECT_NE(record.message.find("it is stuck"), std::string::npos) << record.message;
}

TEST(ArmsMission, WhenAJointTurnsByItself_ThenTheRunEndsSafeAndSaysThatItHasLeftItsPath) {
  ArmsCell cell(kUp, {{3.2, "runaway_right_1", 1.0}});
  const run::RunRecord record = cell.run(cell.options());
  EXPECT_EQ(record.phase, Phase::Safe) << story(record);
  EXPECT_NE(record.message.find("joint 1 of the right arm has left its path"), std::string::npos)
      << record.message;
  ASSERT_EQ(record.incidents.size(), 1u);
  EXPECT_EQ(run::sentence_of(record.incidents[0].evidence), record.message);
  EXPECT_EQ(record.replans[0].cause, record.message) << "what was not known when the arm stopped";
  EXPECT_EQ(cell.contacts(), 0.0);
}

TEST(ArmsMission, WhenADriveTrips_ThenTheRunEndsSafeAndSaysSo) {
  ArmsCell cell(kUp, {{3.2, "overcurrent_right_3", 1.0}});
  const run::RunRecord record = cell.run(cell.options());
  EXPECT_EQ(record.phase, Phase::Safe) << story(record);
  EXPECT_NE(record.message.find("a drive of the right arm has tripped"), std::string::npos) << record.message;
}

assemblies::FixedBody post(double x_m, double y_m) {
  return {"post", assemblies::box_solid({0.08, 0.08, 0.3}), {{}, {x_m, y_m, 0.85}}, false, false};
}

TEST(ArmsMission, WhenSomethingIsPutIntoTheWay_ThenItIsSeenAndPlannedAround) {
  ArmsCell cell(kUp, {{1.0, "block_1", 1.0}}, 1, {post(0.5, -0.25)});
  const run::RunRecord record = cell.run(cell.options());
  expect_done(cell, record);
  expect_on_the_box(cell);
  EXPECT_TRUE(tells(record, "an obstacle stands in the way, at 0.")) << story(record);
  EXPECT_EQ(cell.truth("blocked_1"), 1.0);
  EXPECT_EQ(cell.contacts(), 0.0);
}

// It goes back without touching the post again, and the camera looks once more. By then the post is gone.
TEST(ArmsMission, WhenAnArmMeetsWhatNobodyHasSeen_ThenItGoesBackAndTheOrderIsDoneOnceThereIsAWay) {
  ArmsCell cell(kUp,
                {{1.6, "camera_dead", 1.0},
                 {2.0, "block_1", 1.0},
                 {12.0, "camera_dead", 0.0, true},
                 {14.0, "block_1", 0.0, true}},
                1, {post(0.5, -0.45)});
  const run::RunRecord record = cell.run(cell.options());
  expect_done(cell, record);
  expect_on_the_box(cell);
  EXPECT_TRUE(tells(record, "the way of the right arm is blocked: something stands there, at 0.50 -0.45"))
      << story(record);
  EXPECT_EQ(record.replans.size(), 1u) << story(record);
  ASSERT_EQ(record.episodes.size(), 3u) << story(record) << "the order, the way back, the way home";
  EXPECT_EQ(cell.truth("contacts_arm_fixed"), 1.0) << story(record);
}

// Its way home is blocked as well: it goes back, and stays there.
TEST(ArmsMission, WhenAnArmMeetsWhatNobodyHasSeen_ThenTheRunEndsSafeAndSaysWhatStandsThere) {
  ArmsCell cell(kUp, {{1.6, "camera_dead", 1.0}, {2.0, "block_1", 1.0}, {12.0, "camera_dead", 0.0, true}}, 1,
                {post(0.5, -0.45)});
  const run::RunRecord record = cell.run(cell.options());
  EXPECT_EQ(record.phase, Phase::Safe) << story(record);
  EXPECT_TRUE(tells(record, "the way of the right arm is blocked: something stands there, at 0.50 -0.45"))
      << story(record);
  EXPECT_EQ(cell.truth("contacts_arm_fixed"), 1.0) << story(record);
  EXPECT_FALSE(cell.controller().any_output());
}

TEST(ArmsMission, WhenThereIsNoWayAround_ThenTheRunEndsSafeAndSaysWhatIsInTheWay) {
  ArmsCell cell(kUp, {{1.0, "block_1", 1.0}}, 1, {post(0.45, -0.35)});
  const run::RunRecord record = cell.run(cell.options());
  EXPECT_EQ(record.phase, Phase::Safe) << story(record);
  EXPECT_NE(record.message.find("obstacles are in the way, at 0.45 -0.35 m"), std::string::npos)
      << record.message;
  EXPECT_FALSE(cell.controller().any_output());
}

TEST(ArmsMission, WhenTheCameraIsDead_ThenTheRunEndsSafeAndSaysSo) {
  ArmsCell cell(kUp, {{0.0, "camera_dead", 1.0}});
  const run::RunRecord record = cell.run(cell.options());
  EXPECT_EQ(record.phase, Phase::Safe) << story(record);
  EXPECT_NE(record.message.find("the camera does not report"), std::string::npos) << record.message;
}

TEST(ArmsMission, WhenAnOrderIsOutOfReach_ThenTheRunEndsWithTheReason) {
  ArmsCell cell("(in cup1 red-region)", {{0.0, "shift_x_cup1", 450.0}});
  const run::RunRecord record = cell.run(cell.options());
  EXPECT_EQ(record.phase, Phase::Safe) << story(record);
  EXPECT_NE(record.message.find("no plan"), std::string::npos) << record.message;
  EXPECT_EQ(cell.contacts(), 0.0);
}

TEST(ArmsMission, WhenTheSupervisorIsRestarted_ThenItsProgramGoesOnAndTheCameraJudges) {
  ArmsCell cell(kUp);
  ArmsMissionOptions options = cell.options();
  options.journal = cell.journal();
  struct Killed {};
  try {
    cell.run(options, [&](const run::RunRecord& record) {
      if (!record.episodes.empty() && record.episodes[0].actions[0].state == run::ActionState::Done &&
          record.phase == Phase::Executing)
        throw Killed{};
    });
    FAIL() << "it ended before it was killed";
  } catch (const Killed&) {
  }
  const run::RunRecord record = cell.run(options);
  ASSERT_EQ(record.phase, Phase::Done) << story(record);
  expect_on_the_box(cell);
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::LostSupervisor) << story(record);
  for (const run::ActionRecord& each : record.episodes.front().actions)
    EXPECT_EQ(each.state, run::ActionState::Done) << each.text;
  EXPECT_EQ(cell.contacts(), 0.0);
}

TEST(ArmsMission, WhenTheRuntimeIsLost_ThenTheRunGoesOnFromWhereTheArmsStand) {
  ArmsCell cell(kUp);
  cell.controller().kill_runtime_at(7.0);
  const run::RunRecord record = cell.run(cell.options());
  expect_done(cell, record);
  expect_on_the_box(cell);
  EXPECT_EQ(record.incidents[0].kind, IncidentKind::LostRuntime) << story(record);
}

// What has come of the newest question once it is no longer being planned; null: nobody has asked.
nlohmann::json answer_of(ArmsMission& mission) {
  nlohmann::json told;
  for (int k = 0; k < 12'000; ++k) {
    if (const auto outlook = mission.new_outlook()) told = nlohmann::json::parse(*outlook)["what_if"];
    if (told.is_object() && told["state"] != "planning") break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return told;
}

TEST(ArmsMission, WhenAnOrderIsOnlyLookedAtBeforeTheRun_ThenItsPlanIsToldAndNothingMoves) {
  ArmsCell cell(kUp);
  ArmsMission mission(cell.planning(), cell.controller(), cell.options(), {});
  const auto code = [&](const char* text) { return run::refusal(mission, text); };
  EXPECT_EQ(code(R"({"request": "what_if", "goal": "acros"})"), "G0401");
  EXPECT_EQ(code(R"({"request": "what_if", "goal": 4})"), "X0005");
  EXPECT_EQ(code(R"({"request": "cancel_what_if"})"), "X0008");
  EXPECT_EQ(code(R"({"request": "what_if", "id": "7f", "goal": "across"})"), "");
  const nlohmann::json told = answer_of(mission);
  ASSERT_EQ(told["state"], "planned") << told;
  EXPECT_EQ(told["id"], "7f");
  EXPECT_EQ(told["goal"], "across");
  EXPECT_EQ(told["ahead"], false);
  EXPECT_TRUE(told["running"].is_null());
  const nlohmann::json& plan = told["plan"];
  EXPECT_GE(plan["steps"], 5);
  EXPECT_EQ(plan["actions"][0]["text"], "right picks cup1");
  EXPECT_GT(plan["makespan_s"], 5.0);
  EXPECT_LT(plan["makespan_s"], 100.0);
  EXPECT_EQ(cell.controller().stops(), 0);
  EXPECT_FALSE(cell.controller().any_output());
  // Without a goal it is the order that there is.
  EXPECT_EQ(code(R"({"request": "what_if", "id": "80"})"), "");
  EXPECT_EQ(answer_of(mission)["goal"], kUp);
}

TEST(ArmsMission, WhenAnOrderIsOnlyLookedAtMeanwhile_ThenItBeginsWhereTheActionsLeadAndTheRunIsTheSame) {
  ArmsCell undisturbed(kUp), cell(kUp);
  const run::RunRecord same = undisturbed.run(undisturbed.options());
  ArmsMission* asked = nullptr;
  std::string code = "nobody has asked";
  ArmsMission mission(cell.planning(), cell.controller(), cell.options(), [&](const run::RunRecord& now) {
    if (asked == nullptr || now.phase != Phase::Executing) return;
    if (now.episodes.back().actions[0].state != run::ActionState::Done) return;
    code = run::refusal(*std::exchange(asked, nullptr),
                        R"({"request": "what_if", "id": "7f", "goal": "across"})");
  });
  asked = &mission;
  const run::RunRecord record = mission.run();
  EXPECT_EQ(code, "");
  expect_done(cell, record);
  EXPECT_EQ(record.finished_s, same.finished_s);
  const nlohmann::json told = answer_of(mission);
  ASSERT_EQ(told["state"], "planned") << told;
  EXPECT_GT(told["running"]["steps"], 0);
  EXPECT_LT(told["running"]["steps"], record.episodes[0].actions.size());
  EXPECT_GT(told["running"]["makespan_s"], 0.0);
  // The cup is in the hand by then, and will stand on the box.
  EXPECT_EQ(told["plan"]["actions"][0]["text"], "left picks cup1") << told;
}

TEST(ArmsMission, WhenRequestsMeanNothing_ThenTheyAreRefusedAtOnce) {
  ArmsCell cell(kUp);
  ArmsMission mission(cell.planning(), cell.controller(), cell.options(), {});
  const auto code = [&](const char* text) { return run::refusal(mission, text); };
  EXPECT_NE(mission.goal_form().find("\"across\""), std::string::npos);
  EXPECT_EQ(code(R"({"request": "goal", "goal": "acros"})"), "G0401");
  EXPECT_EQ(code(R"_({"request": "goal", "goal": "(in cup2 table)"})_"), "G0401");
  EXPECT_EQ(code(R"({"request": "goal"})"), "X0005");
  EXPECT_EQ(code(R"({"request": "block", "name": "x"})"), "X0003");
  EXPECT_EQ(code(R"({"request": "start"})"), "X0008");
  EXPECT_EQ(code(R"({"request": "goal", "goal": "across"})"), "");
  EXPECT_EQ(code(R"_({"request": "goal", "goal": "(in cup1 table)"})_"), "");
}

}  // namespace
}  // namespace stepwright::tamp::mission

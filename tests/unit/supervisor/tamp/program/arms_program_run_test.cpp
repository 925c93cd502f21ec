// Programs of arms on the simulated robot cell: plans are carried out without a contact, what goes wrong ends
// in the step of its cause, people can hold and slow down, and programs take over from each other.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/support/arms_program/arms_rig.h"
#include "tests/support/arms_program/planned_arms.h"

namespace stepwright::tamp::program {
namespace {

ArmsProgram program_of(const test::PlannedArms& planned, ArmsProgramKind kind,
                       const ArmsProgramOptions& options = {}) {
  auto made = arms_program({.kind = kind, .cell = &planned.cell, .schedule = &planned.schedule},
                           cell_terminals_in_a_row(2, 4), options);
  if (!made) throw std::runtime_error(result::to_string(made.error()));
  return *std::move(made);
}

const std::vector<std::byte>& following(const std::string& problem) {
  static std::map<std::string, std::vector<std::byte>> made;
  std::vector<std::byte>& container = made[problem];
  if (container.empty())
    container = test::compiled(program_of(test::planned_once(problem), ArmsProgramKind::Follow));
  return container;
}

bool at_work(const test::ArmsRig& rig) {
  const std::string at = rig.step(kCellChart);
  return at.empty() || at == "START" || at == "POWER" || at == "RUN";
}

std::string where(const test::ArmsRig& rig) {
  return rig.step(kCellChart) + ", left " + rig.step("arm_left") + ", right " + rig.step("arm_right") +
         ", errors " + std::to_string(rig.number("error_left")) + " " +
         std::to_string(rig.number("error_right")) + ", room " + std::to_string(rig.number("arms_room"));
}

// Until an arm is in a step of that kind.
void run_to(test::ArmsRig& rig, const std::string& kind, const std::string& chart = "arm_right") {
  while (rig.time_s() < 100.0 && at_work(rig) && rig.step(chart).find(kind) == std::string::npos) rig.scan();
  ASSERT_TRUE(at_work(rig)) << where(rig);
}

// Things stand where the plan says they do in the end.
void expect_done(const test::PlannedArms& planned, const test::ArmsRig& rig) {
  std::map<int, scene::Pose> last;
  for (const scene::PlannedAction& each : planned.plan.actions)
    if (each.what.kind == scene::ActionKind::Place) last[each.what.thing] = each.pose;
  for (const auto& [thing, pose] : last) {
    const std::string& name = planned.cell.things[static_cast<std::size_t>(thing)].name;
    EXPECT_NEAR(rig.truth("x_" + name), pose.x_m, 0.003) << name;
    EXPECT_NEAR(rig.truth("y_" + name), pose.y_m, 0.003) << name;
    EXPECT_NEAR(rig.truth("z_" + name), pose.z_m, 0.001) << name;
    EXPECT_EQ(rig.truth("state_" + name), 0.0) << name;
  }
  EXPECT_EQ(rig.incidents(), 0.0) << rig.incident_texts();
}

TEST(ArmsProgramRun, WhenACupChangesHands_ThenItStandsWhereThePlanSaysAndNothingWasTouched) {
  const test::PlannedArms& p1 = test::planned_once("p1");
  test::ArmsRig rig(p1.cell, {});
  rig.load(following("p1"));
  bool grasped = false;
  double progress = 0.0, off_rad = 0.0;
  while (rig.time_s() < 2.0 * p1.schedule.sequential_s + 10.0 && at_work(rig)) {
    rig.scan();
    grasped = grasped || rig.number("grasped_left") != 0.0;
    EXPECT_GE(rig.number("progress_right"), progress);
    progress = rig.number("progress_right");
    // Set points make up for what drives lag behind: arms are where their paths are, within what a hand has
    // room.
    for (const char* joint : {"1", "2", "4", "6"})
      off_rad =
          std::max(off_rad, std::abs(rig.truth(std::string("true_right_") + joint) -
                                     rig.number(std::string("group_right.SetPosition[") + joint + "]")));
  }
  EXPECT_LT(off_rad, 0.012);
  EXPECT_EQ(rig.step(kCellChart), "DONE") << where(rig);
  EXPECT_TRUE(grasped);
  EXPECT_LT(rig.time_s(), 1.2 * p1.schedule.makespan_s + 3.0);
  expect_done(p1, rig);
}

// The interlock measures with the cup from when the fingers close on it until they open.
TEST(ArmsProgramRun, WhenAHandHoldsAThing_ThenTheInterlockKnowsItsBody) {
  const test::PlannedArms& p1 = test::planned_once("p1");
  test::ArmsRig rig(p1.cell, {});
  rig.load(following("p1"));
  schedule::ArmCapsules left = schedule::arm_capsules(p1.cell, 0), right = schedule::arm_capsules(p1.cell, 1);
  const auto own = static_cast<double>(right.capsules.size());
  const auto& steps = p1.schedule.arms[1].steps;
  const auto grip = std::ranges::find(steps, schedule::StepKind::Grip, &schedule::ScheduledStep::kind);
  ASSERT_NE(grip, steps.end());
  ASSERT_TRUE(grip->held);
  const auto joints = [&](const std::string& arm) {
    std::vector<double> all;
    for (int k = 1; k <= 7; ++k) all.push_back(rig.number("joint_" + arm + "_" + std::to_string(k)));
    return all;
  };
  const schedule::ArmCapsules empty = right;
  right.capsules.push_back(*grip->held);
  run_to(rig, "GRIP");
  int nearer = 0;
  while (rig.step("arm_right").find("APPROACH") == std::string::npos && at_work(rig)) {
    const bool holds = rig.number("model_right.Capsules") == own + 1.0;
    const auto there = schedule::capsules_at(left, joints("left"));
    const double bare_m = schedule::distance_of(there, schedule::capsules_at(empty, joints("right")));
    const double held_m = schedule::distance_of(there, schedule::capsules_at(right, joints("right")));
    EXPECT_NEAR(rig.number("arms_distance"), holds ? held_m : bare_m, 1e-9) << where(rig);
    if (holds && held_m < bare_m - 0.005) ++nearer;
    rig.scan();
  }
  EXPECT_GT(nearer, 0) << "the cup is never the nearest";
  EXPECT_TRUE(rig.run(100.0)) << where(rig);
  EXPECT_EQ(rig.number("model_right.Capsules"), own);
}

TEST(ArmsProgramRun, WhenBothArmsHaveWork_ThenTheyWorkAtTheSameTimeAndDoNotMeet) {
  const test::PlannedArms& cups = test::planned_once("two_cups");
  test::ArmsRig rig(cups.cell, {.seed = 2});
  rig.load(following("two_cups"));
  EXPECT_TRUE(rig.run(200.0)) << where(rig);
  EXPECT_LT(rig.time_s(), 0.85 * cups.schedule.sequential_s);
  expect_done(cups, rig);
}

TEST(ArmsProgramRun, WhenCansAreSetDownSideBySide_ThenHandsHaveRoomBetweenThem) {
  const test::PlannedArms& p4 = test::planned_once("p4");
  test::ArmsRig rig(p4.cell, {.seed = 4});
  rig.load(following("p4"));
  EXPECT_TRUE(rig.run(60.0)) << where(rig);
  expect_done(p4, rig);
}

TEST(ArmsProgramRun, WhenAnArmIsLate_ThenTheOtherOneStandsOnItsPathUntilItHasPassed) {
  const test::PlannedArms& cups = test::planned_once("two_cups");
  test::ArmsRig rig(cups.cell, {.seed = 3});
  rig.load(following("two_cups"));
  // The left hand takes its time to grasp; the right arm would come to the middle before the left one has
  // left it.
  run_to(rig, "LINEAR", "arm_left");
  rig.fault("dead_hand_left", 1.0);
  run_to(rig, "GRIP", "arm_left");
  rig.run_for(1.2);
  rig.clear("dead_hand_left");
  bool stood = false;
  while (rig.time_s() < 200.0 && at_work(rig)) {
    rig.scan();
    const double share = rig.number("progress_right") - std::floor(rig.number("progress_right"));
    stood =
        stood || (rig.number("waiting_right") != 0.0 && rig.number("standing_right") != 0.0 && share > 0.1);
  }
  EXPECT_EQ(rig.step(kCellChart), "DONE") << where(rig);
  EXPECT_TRUE(stood);
  expect_done(cups, rig);
}

// The share of what a joint may be off its set point that any joint has needed.
double share_of_following(const test::PlannedArms& planned, const std::vector<std::byte>& container) {
  test::ArmsRig rig(planned.cell, {});
  rig.load(container);
  double most = 0.0;
  while (rig.time_s() < 200.0 && at_work(rig)) {
    rig.scan();
    for (const char* group : {"group_left.", "group_right."}) {
      if (rig.number(std::string(group) + "DriveOn") == 0.0) continue;
      const double period_s = rig.number(std::string(group) + "LongPeriod");
      for (int k = 1; k <= 7; ++k) {
        const auto of = [&](const char* what) {
          return rig.number(std::string(group) + what + "[" + std::to_string(k) + "]");
        };
        const double off_rad = std::abs(of("SetPosition") - of("ActualPosition"));
        most = std::max(most, off_rad / (of("MaxFollowingError") + std::abs(of("SetVelocity")) * period_s));
      }
    }
  }
  EXPECT_EQ(rig.step(kCellChart), "DONE") << where(rig);
  return most;
}

TEST(ArmsProgramRun, WhenNothingIsWrong_ThenJointsFollowWithAMargin) {
  for (const char* problem : {"p1", "p2", "p3", "p4", "p5", "p6", "two_cups"})
    EXPECT_LT(share_of_following(test::planned_once(problem), following(problem)), 0.7) << problem;
}

// By less than fingers have room, wherever on its way it was; the program names it.
TEST(ArmsProgramRun, WhenAJointSticks_ThenItsArmStandsBeforeTheHandIsOffItsPath) {
  const test::PlannedArms& p1 = test::planned_once("p1");
  for (const int joint : {1, 2, 4, 6}) {
    test::ArmsRig rig(p1.cell, {});
    rig.load(following("p1"));
    run_to(rig, "LINEAR");
    rig.run_for(0.2);
    rig.fault("stuck_right_" + std::to_string(joint), 1.0);
    EXPECT_FALSE(rig.run(rig.time_s() + 20.0)) << joint;
    EXPECT_EQ(rig.step(kCellChart), "DRIVE_FAULT") << where(rig);
    EXPECT_EQ(rig.number("group_right.FailedJoint"), joint);
    EXPECT_LT(std::abs(rig.number("group_right.FailedBy")), 0.02) << joint;
    rig.run_for(1.0);
    EXPECT_EQ(rig.incidents(), 0.0) << joint << ": " << rig.incident_texts();
  }
}

TEST(ArmsProgramRun, WhenSomethingGoesWrong_ThenItEndsInTheStepOfItsCauseAndTheArmsStand) {
  struct Case {
    const char* during;  // of the right arm's steps
    const char* fault;
    double value;
    const char* step;
    int arm;
  };
  const Case cases[] = {{"APPROACH", "shift_y_cup1", 150.0, "MISSED_GRASP", 2},
                        {"LINEAR", "dead_hand_right", 1.0, "MISSED_GRASP", 2},
                        {"TRANSFER", "drop_right", 1.0, "LOST_GRASP", 2},
                        {"APPROACH", "overcurrent_right_3", 1.0, "DRIVE_FAULT", 2},
                        {"TRANSFER", "runaway_right_7", 2.0, "DRIVE_FAULT", 2},
                        {"LINEAR", "stuck_right_2", 1.0, "DRIVE_FAULT", 2},
                        {"APPROACH", "press_estop", 1.0, "EMERGENCY_STOP", 0}};
  const std::vector<std::byte> observing = test::compiled(
      program_of(test::planned_once("p1"), ArmsProgramKind::Observe, {.reports = 1, .reset = 1}));
  for (const Case& each : cases) {
    test::ArmsRig rig(test::planned_once("p1").cell, {});
    rig.load(following("p1"));
    run_to(rig, each.during);
    rig.run_for(0.3);
    rig.fault(each.fault, each.value);
    EXPECT_FALSE(rig.run(rig.time_s() + 20.0)) << each.fault;
    EXPECT_EQ(rig.step(kCellChart), each.step) << each.fault << ": " << where(rig);
    EXPECT_EQ(rig.number("cause_arm"), each.arm) << each.fault;
    rig.run_for(1.5);
    EXPECT_EQ(rig.number("at_rest"), 1.0) << each.fault;
    const double before = rig.truth("true_left_2") + rig.truth("true_right_1");
    rig.run_for(0.2);
    EXPECT_NEAR(rig.truth("true_left_2") + rig.truth("true_right_1"), before, 1e-3) << each.fault;
    EXPECT_EQ(rig.truth("contacts_arm_fixed") + rig.truth("contacts_arm_arm"), 0.0) << each.fault;
    if (std::string(each.fault) != "press_estop" && std::string(each.fault) != "overcurrent_right_3")
      continue;
    // Once the reason is gone, the next program resets what it has left.
    rig.clear(each.fault);
    rig.load(observing);
    EXPECT_TRUE(rig.run(rig.time_s() + 10.0)) << each.fault << ": " << rig.step(kCellChart);
    EXPECT_EQ(rig.number("error_left") + rig.number("error_right"), 0.0) << each.fault;
    EXPECT_EQ(rig.number("cause") + rig.number("trip_right"), 0.0) << each.fault;
  }
}

TEST(ArmsProgramRun, WhenPeopleHoldAndSlowDown_ThenArmsStayOnTheirPathsAndGoOn) {
  test::ArmsRig rig(test::planned_once("p1").cell, {});
  rig.load(following("p1"));
  run_to(rig, "APPROACH");
  rig.run_for(0.3);
  rig.set_bool("operator_hold", true);
  rig.run_for(1.5);
  EXPECT_EQ(rig.number("standing_right"), 1.0);
  const double progress = rig.number("progress_right");
  rig.run_for(0.5);
  EXPECT_EQ(rig.number("progress_right"), progress);
  EXPECT_TRUE(at_work(rig));
  rig.set_bool("operator_hold", false);
  rig.set_real("operator_speed", 0.5);
  run_to(rig, "TRANSFER");
  rig.set_real("operator_speed", 1.0);
  EXPECT_TRUE(rig.run(150.0)) << where(rig);
  expect_done(test::planned_once("p1"), rig);
}

// At the end of P1 both arms are elsewhere than where they began, and so say what that program has left.
TEST(ArmsProgramRun, WhenArmsHaveNothingToDo_ThenOnlyWhereTheyAreCounts) {
  const test::PlannedArms& p1 = test::planned_once("p1");
  test::ArmsRig rig(p1.cell, {});
  rig.load(following("p1"));
  EXPECT_TRUE(rig.run(100.0)) << where(rig);
  test::PlannedArms next = p1;
  for (std::size_t arm = 0; arm < next.schedule.arms.size(); ++arm) {
    schedule::ArmSchedule& rests = next.schedule.arms[arm];
    rests.steps.clear();
    for (std::size_t j = 0; j < 7; ++j)
      rests.start[j] = rig.truth("true_" + p1.cell.arms[arm].name + "_" + std::to_string(j + 1));
  }
  rig.load(test::compiled(program_of(next, ArmsProgramKind::Follow)));
  EXPECT_TRUE(rig.run(rig.time_s() + 10.0)) << where(rig);
  // The other arm's paths count on it being there.
  next.schedule.arms[1].start[0] += 0.1;
  rig.load(test::compiled(program_of(next, ArmsProgramKind::Follow)));
  EXPECT_FALSE(rig.run(rig.time_s() + 10.0));
  EXPECT_EQ(rig.step(kCellChart), "NOT_AT_START") << where(rig);
  EXPECT_EQ(rig.number("cause_arm"), 2.0);
}

TEST(ArmsProgramRun, WhenOthersTakeOver_ThenArmsComeToRestOnTheirPathsAndTheCameraReports) {
  const test::PlannedArms& p1 = test::planned_once("p1");
  test::ArmsRig rig(p1.cell, {});
  rig.load(test::compiled(program_of(p1, ArmsProgramKind::Observe)));
  EXPECT_TRUE(rig.run(10.0)) << rig.step(kCameraChart);
  EXPECT_EQ(rig.number("camera_reports"), 3.0);
  int cups = 0;
  for (int k = 0; k < 12; ++k)
    if (rig.number("seen_kind[" + std::to_string(k) + "]") == 1.0 &&
        std::abs(rig.number("seen_y[" + std::to_string(k) + "]") + 4500.0) < 100.0)
      ++cups;
  EXPECT_GE(cups, 2);
  rig.load(following("p1"));
  run_to(rig, "TRANSFER");
  rig.run_for(0.3);
  const double progress = rig.number("progress_right");
  rig.load(test::compiled(program_of(p1, ArmsProgramKind::Halt)));
  EXPECT_TRUE(rig.run(rig.time_s() + 3.0)) << rig.step(kCellChart);
  EXPECT_EQ(rig.number("error_right"), 0.0);
  EXPECT_EQ(rig.truth("held_right"), 1.0);
  // On the path: where the schedule has it at the progress at which it stands.
  EXPECT_GT(rig.number("progress_right"), progress);
  const auto k = static_cast<std::size_t>(rig.number("progress_right"));
  const schedule::ScheduledStep& step = p1.schedule.arms[1].steps[k];
  ASSERT_TRUE(step.motion);
  motion::Configuration joints(7);
  const double time_s = (rig.number("progress_right") - static_cast<double>(k)) * step.duration_s;
  step.motion->path.at(step.motion->law.at(time_s).place, joints);
  rig.run_for(0.5);
  for (std::size_t j = 0; j < 7; ++j)
    EXPECT_NEAR(rig.truth("true_right_" + std::to_string(j + 1)), joints[j], 0.003);
  // Nobody goes on from here by the old schedule.
  rig.load(following("p1"));
  EXPECT_FALSE(rig.run(rig.time_s() + 5.0));
  EXPECT_EQ(rig.step(kCellChart), "NOT_AT_START") << where(rig);
  EXPECT_EQ(rig.truth("held_right"), 1.0);
}

}  // namespace
}  // namespace stepwright::tamp::program

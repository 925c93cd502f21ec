// The picture of a cell of arms: its joints beside the planner's kinematics, its things beside the plan, its
// names beside the compiled program.

#include "supervisor/tamp/pictures/draw_arms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "runtime/bytecode/reader/program_info.h"
#include "supervisor/motion/kinematics/link_frames.h"
#include "supervisor/motion/spatial/random.h"
#include "supervisor/tamp/schedule/arm_capsules.h"
#include "supervisor/tamp/schedule/replay.h"
#include "tests/support/arms_program/arms_rig.h"
#include "tests/support/arms_program/planned_arms.h"

namespace stepwright::tamp::pictures {
namespace {

using motion::Transform;
using motion::Vector3;
using Values = std::map<std::string, double>;

const test::PlannedArms& planned() {
  return test::planned_once("two_cups");
}

program::ArmsProgram program_of(program::ArmsProgramKind kind, std::chrono::milliseconds camera_every) {
  const bool observes = kind == program::ArmsProgramKind::Observe;
  auto made = program::arms_program(
      {.kind = kind, .cell = &planned().cell, .schedule = observes ? nullptr : &planned().schedule},
      program::cell_terminals_in_a_row(2, 4), {.camera_every = camera_every});
  if (!made) throw std::runtime_error(result::to_string(made.error()));
  return *std::move(made);
}

const program::ArmsProgram& following() {
  static const program::ArmsProgram made =
      program_of(program::ArmsProgramKind::Follow, std::chrono::milliseconds(0));
  return made;
}

ArmsPicture pictured() {
  return arms_picture(
      {.cell = &planned().cell, .schedule = &planned().schedule, .program = &following(), .digest = "ab"});
}

// What the page does with a picture, in the same words.
Transform placed(const PicturePlace& place) {
  return {motion::Rotation{place.rotation}, {place.at_m[0], place.at_m[1], place.at_m[2]}};
}

Vector3 vector(const PicturePoint& point) {
  return {point[0], point[1], point[2]};
}

double value_of(const PictureValue& value, const Values& known) {
  if (value.variable.empty()) return value.offset;
  const auto found = known.find(value.variable);
  return value.factor * (found == known.end() ? value.rest : found->second) + value.offset;
}

std::vector<Transform> frames_of(const ArmsPicture& picture, const Values& known) {
  std::vector<Transform> all;
  for (const ArmsPicture::Frame& each : picture.frames) {
    Transform moved;
    const double value = value_of(each.value, known);
    if (each.motion == ArmsPicture::Motion::Turns)
      moved.rotation = motion::about(vector(each.axis), value);
    else if (each.motion == ArmsPicture::Motion::Slides)
      moved.position_m = value * vector(each.axis);
    const Transform parent = each.parent < 0 ? Transform{} : all.at(static_cast<std::size_t>(each.parent));
    all.push_back(parent * placed(each.place) * moved);
  }
  return all;
}

double apart(const Transform& a, const Transform& b) {
  double most = distance(a.position_m, b.position_m);
  for (std::size_t k = 0; k < 9; ++k) most = std::max(most, std::abs(a.rotation.m[k] - b.rotation.m[k]));
  return most;
}

// Within the limits of the joints, and the program's variables that say so.
struct Drawn {
  std::vector<double> values;  // of the robot's coordinates
  std::vector<std::vector<double>> joints;
  Values known;
};

Drawn draw(motion::Random& random) {
  const scene::RobotCell& cell = planned().cell;
  Drawn drawn{.values = cell.rest, .joints = {}, .known = {}};
  for (std::size_t arm = 0; arm < cell.arms.size(); ++arm) {
    const program::ArmVariables& named = following().variables.arms[arm];
    const scene::ArmModel& model = cell.arms[arm];
    drawn.joints.emplace_back();
    for (std::size_t k = 0; k < model.coordinates.size(); ++k) {
      const auto& joint = model.chain.joints()[k];
      const double q = random.between(joint.lower, joint.upper);
      drawn.joints.back().push_back(q);
      drawn.values[static_cast<std::size_t>(model.coordinates[k])] = q;
      drawn.known[named.angles[k]] = 1e4 * q;
    }
    const double half_m = random.between(0.0, 0.045);
    drawn.values[static_cast<std::size_t>(model.gripper)] = half_m;
    drawn.known[named.opening] = 1e4 * 2.0 * half_m;
  }
  return drawn;
}

TEST(ArmsPicture, WhenJointsAreAnywhere_ThenToolsAndFingersAreWhereTheKinematicsHasThem) {
  const ArmsPicture picture = pictured();
  const scene::RobotCell& cell = planned().cell;
  ASSERT_EQ(picture.arms.size(), 2u);
  const motion::LinkFrames kinematics(cell.robot);
  std::vector<Transform> links(cell.robot.links.size());
  motion::Random random(3);
  for (int round = 0; round < 200; ++round) {
    const Drawn drawn = draw(random);
    const std::vector<Transform> frames = frames_of(picture, drawn.known);
    ASSERT_EQ(frames.size(), links.size());
    kinematics.place(drawn.values, links);
    for (std::size_t link = 0; link < links.size(); ++link)
      EXPECT_LT(apart(frames[link], links[link]), 1e-9) << picture.frames[link].name;
    for (std::size_t arm = 0; arm < 2; ++arm) {
      const scene::ArmModel& model = cell.arms[arm];
      EXPECT_LT(apart(frames[static_cast<std::size_t>(picture.arms[arm].tool)],
                      model.base * model.chain.forward(drawn.joints[arm])),
                1e-9);
    }
  }
}

TEST(ArmsPicture, WhenJointsAreAnywhere_ThenCapsulesAreThoseOfTheInterlock) {
  const ArmsPicture picture = pictured();
  motion::Random random(4);
  for (int round = 0; round < 50; ++round) {
    const Drawn drawn = draw(random);
    const std::vector<Transform> frames = frames_of(picture, drawn.known);
    for (std::size_t arm = 0; arm < 2; ++arm) {
      const auto wanted =
          schedule::capsules_at(schedule::arm_capsules(planned().cell, arm), drawn.joints[arm]);
      const auto& made = picture.arms[arm].capsules;
      ASSERT_EQ(made.size(), wanted.size());
      for (std::size_t k = 0; k < made.size(); ++k) {
        const Transform& frame = frames[static_cast<std::size_t>(made[k].frame)];
        EXPECT_LT(distance(frame * vector(made[k].from_m), wanted[k].from), 1e-9);
        EXPECT_LT(distance(frame * vector(made[k].to_m), wanted[k].to), 1e-9);
        EXPECT_EQ(made[k].radius_m, wanted[k].radius_m);
      }
    }
  }
}

TEST(ArmsPicture, WhenAHandHoldsAThing_ThenItsCapsuleIsThatOfTheInterlockFromGripToRelease) {
  const ArmsPicture picture = pictured();
  motion::Random random(5);
  const Drawn drawn = draw(random);
  const std::vector<Transform> frames = frames_of(picture, drawn.known);
  std::size_t grips = 0;
  for (std::size_t arm = 0; arm < 2; ++arm) {
    const auto& steps = planned().schedule.arms[arm].steps;
    std::size_t k = 0;
    for (const ArmsPicture::Held& each : picture.arms[arm].held) {
      while (k < steps.size() && steps[k].kind != schedule::StepKind::Grip) ++k;
      ASSERT_LT(k, steps.size());
      EXPECT_EQ(each.from, static_cast<double>(k));
      schedule::ArmCapsules model = schedule::arm_capsules(planned().cell, arm);
      model.capsules = {steps[k].held.value()};
      const schedule::Capsule wanted = schedule::capsules_at(model, drawn.joints[arm]).front();
      const Transform& frame = frames[static_cast<std::size_t>(each.body.frame)];
      EXPECT_LT(distance(frame * vector(each.body.from_m), wanted.from), 1e-9);
      EXPECT_LT(distance(frame * vector(each.body.to_m), wanted.to), 1e-9);
      while (steps[k].kind != schedule::StepKind::Release) ++k;
      EXPECT_EQ(each.until, static_cast<double>(k));
      ++grips;
    }
  }
  EXPECT_GE(grips, 2u) << "there are two cups";
}

TEST(ArmsPicture, WhenThereIsABody_ThenItIsThatOfTheRobotAndOfItsArm) {
  const ArmsPicture picture = pictured();
  const scene::RobotCell& cell = planned().cell;
  for (std::size_t link = 0; link < cell.robot.links.size(); ++link) {
    const std::string& name = cell.robot.links[link].name;
    EXPECT_EQ(picture.frames[link].solids.size(), cell.bodies[link].size()) << name;
    const int arm = name.starts_with("left_") ? 0 : name.starts_with("right_") ? 1 : -1;
    EXPECT_EQ(picture.frames[link].arm, arm) << name;
  }
  ASSERT_EQ(picture.bodies.size(), cell.furniture.size());
  EXPECT_EQ(picture.bodies[0].name, "board");
  EXPECT_NEAR(picture.bodies[0].solids.at(0).place.at_m[2], 0.68, 1e-12) << "of its middle";
}

// The last of its stages that has begun.
Transform thing_at(const ArmsPicture::Thing& thing, const std::vector<double>& progress,
                   const std::vector<Transform>& frames, int& holder) {
  ArmsPicture::Stage last;
  for (const ArmsPicture::Stage& each : thing.stages)
    if (each.arm < 0 || progress[static_cast<std::size_t>(each.arm)] >= each.from) last = each;
  holder = last.frame;
  const Transform place = placed(last.place);
  return last.frame < 0 ? place : frames[static_cast<std::size_t>(last.frame)] * place;
}

TEST(ArmsPicture, WhenTheScheduleIsDriven_ThenThingsGoWithHandsWithoutAJumpToWhereThePlanPutsThem) {
  const ArmsPicture picture = pictured();
  const scene::RobotCell& cell = planned().cell;
  schedule::Replay replay(planned().schedule);
  std::vector<Transform> last(cell.things.size());
  for (std::size_t k = 0; k < last.size(); ++k) last[k] = scene::frame_of(cell.things[k].start);
  std::set<int> holders;
  std::vector<Transform> frames;
  for (int round = 0; round < 10'000; ++round) {
    Values known;
    std::vector<double> progress;
    for (std::size_t arm = 0; arm < 2; ++arm) {
      const motion::Configuration joints = replay.joints(arm);
      for (std::size_t k = 0; k < joints.size(); ++k)
        known[following().variables.arms[arm].angles[k]] = 1e4 * joints[k];
      progress.push_back(replay.progress(arm));
    }
    frames = frames_of(picture, known);
    for (std::size_t k = 0; k < last.size(); ++k) {
      int holder = -1;
      const Transform at = thing_at(picture.things[k], progress, frames, holder);
      holders.insert(holder);
      ASSERT_LT(distance(at.position_m, last[k].position_m), 0.03) << picture.things[k].name << ", " << round;
      last[k] = at;
    }
    if (replay.done()) break;
    replay.advance(0.01, {1.0, 1.0});
  }
  ASSERT_TRUE(replay.done());
  EXPECT_EQ(holders, (std::set<int>{-1, cell.arms[0].tip, cell.arms[1].tip})) << "both arms carry";
  std::map<int, scene::Pose> wanted;
  for (const scene::PlannedAction& each : planned().plan.actions)
    if (each.what.kind == scene::ActionKind::Place) wanted[each.what.thing] = each.pose;
  ASSERT_EQ(wanted.size(), 2u);
  for (const auto& [thing, pose] : wanted) {
    const Vector3 at = last[static_cast<std::size_t>(thing)].position_m;
    EXPECT_LT(distance(at, {pose.x_m, pose.y_m, pose.z_m}), 0.002) << thing;
  }
}

TEST(ArmsPicture, WhenAnArmFollowsItsWay_ThenItsToolIsOnIt) {
  const ArmsPicture picture = pictured();
  const scene::RobotCell& cell = planned().cell;
  for (std::size_t arm = 0; arm < 2; ++arm) {
    const auto& way = picture.arms[arm].way;
    const auto& steps = planned().schedule.arms[arm].steps;
    ASSERT_EQ(picture.arms[arm].steps.size(), steps.size());
    ASSERT_GT(way.size(), 50u);
    for (std::size_t k = 0; k + 1 < way.size(); ++k) {
      EXPECT_GE(way[k + 1].progress, way[k].progress);
      EXPECT_LT(distance(vector(way[k].at_m), vector(way[k + 1].at_m)), 0.05) << k;
    }
    for (std::size_t k = 0; k < way.size(); k += 7) {
      const auto step = std::min(static_cast<std::size_t>(way[k].progress), steps.size() - 1);
      const double share = way[k].progress - static_cast<double>(step);
      if (!steps[step].motion || share == 0.0) continue;
      motion::Configuration q(7);
      const schedule::TimedMotion& motion = *steps[step].motion;
      motion.path.at(motion.law.at(share * motion.duration_s()).place, q);
      const Vector3 wanted = (cell.arms[arm].base * cell.arms[arm].chain.forward(q)).position_m;
      EXPECT_LT(distance(vector(way[k].at_m), wanted), 1e-9) << k;
    }
  }
}

// All names that a page would ask for.
std::set<std::string> names_of(const ArmsPicture& picture) {
  std::set<std::string> all = {picture.distance, picture.cause, picture.cause_arm};
  for (const ArmsPicture::Frame& each : picture.frames) all.insert(each.value.variable);
  for (const ArmsPicture::Arm& each : picture.arms)
    all.insert({each.opening.variable, each.progress, each.waiting, each.grasped, each.standing, each.error});
  for (const ArmsPicture::Seen& each : picture.seen)
    all.insert({each.kind, each.x.variable, each.y.variable, each.z.variable, each.yaw.variable});
  all.erase("");
  return all;
}

TEST(ArmsPicture, WhenItNamesVariables_ThenTheCompiledProgramHasThem) {
  using program::ArmsProgramKind;
  const std::chrono::milliseconds never(0), often(500);
  for (const auto& [kind, camera_every, least] : {std::tuple(ArmsProgramKind::Follow, never, 25u),
                                                  {ArmsProgramKind::Follow, often, 45u},
                                                  {ArmsProgramKind::Halt, never, 25u},
                                                  {ArmsProgramKind::Observe, never, 40u}}) {
    const program::ArmsProgram made = program_of(kind, camera_every);
    const bool plans = kind != ArmsProgramKind::Observe;
    const ArmsPicture picture = arms_picture({.cell = &planned().cell,
                                              .schedule = plans ? &planned().schedule : nullptr,
                                              .program = &made,
                                              .digest = "ab"});
    const auto info = reader::ProgramInfo::read(test::compiled(made));
    ASSERT_TRUE(info);
    std::set<std::string> there;
    for (const auto& tag : info->tags()) there.insert(tag.name);
    const std::set<std::string> named = names_of(picture);
    EXPECT_GE(named.size(), least);
    for (const std::string& each : named) EXPECT_TRUE(there.contains(each)) << each;
  }
}

TEST(ArmsPicture, WhenNothingRunsYet_ThenArmsStandWhereTheStateHasThem) {
  scene::GeometricState state = scene::initial_state(planned().cell);
  state.arms[0].at[1] = 0.3;
  state.things[0].pose.x_m += 0.05;
  const ArmsPicture picture = arms_picture({.cell = &planned().cell, .start = &state});
  EXPECT_EQ(picture.program, "");
  EXPECT_TRUE(names_of(picture).empty());
  std::vector<Transform> links(planned().cell.robot.links.size());
  motion::LinkFrames(planned().cell.robot).place(scene::values_of(planned().cell, state), links);
  const std::vector<Transform> frames = frames_of(picture, {});
  for (std::size_t k = 0; k < links.size(); ++k) EXPECT_LT(apart(frames[k], links[k]), 1e-9);
  ASSERT_EQ(picture.things[0].stages.size(), 1u);
  EXPECT_DOUBLE_EQ(picture.things[0].stages[0].place.at_m[0], state.things[0].pose.x_m);
}

}  // namespace
}  // namespace stepwright::tamp::pictures

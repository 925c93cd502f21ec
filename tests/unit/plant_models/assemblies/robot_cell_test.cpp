#include "plant_models/assemblies/robot_cell.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "plant_models/core/counter_random.h"
#include "tests/support/malloc_guard.h"
#include "tests/unit/plant_models/assemblies/robot_cell_rig.h"

namespace stepwright::assemblies {
namespace {

using robot_rig::cell;
using robot_rig::kTop_m;
using robot_rig::Rig;

const ObjectFigures kCup{"cup", ObjectKind::Cup, 0.5, 0.0, 0.3, {}, 0.0};

// Down to the cup, and up again with it.
void lift_cup(Rig& rig) {
  rig.go({0.5, 0.76}, 1.0);
  rig.grip(0.06);
  rig.go({0.5, 0.95}, 1.0);
}

TEST(RobotCell, WhenACupIsLiftedCarriedAndSetDown_ThenItStandsThereAndNobodyIsToBlame) {
  Rig rig(cell({kCup}));
  lift_cup(rig);
  EXPECT_EQ(rig.truth("held_left"), 1.0);
  EXPECT_EQ(rig.sensor("grasp_left"), 1);
  EXPECT_NEAR(rig.sensor("width_left"), 700, 1);
  EXPECT_EQ(rig.truth("state_cup"), 1.0);
  EXPECT_NEAR(rig.truth("z_cup"), kTop_m + 0.19, 0.003);
  rig.go({0.6, 0.95}, 1.0);
  rig.go({0.6, 0.76}, 1.0);
  rig.run(0.3);
  rig.grip(0.09);
  rig.go({0.6, 0.95}, 1.0);
  EXPECT_EQ(rig.truth("state_cup"), 0.0);
  EXPECT_EQ(rig.truth("on_cup"), 1.0);  // the table
  EXPECT_NEAR(rig.truth("x_cup"), 0.6, 0.002);
  EXPECT_NEAR(rig.truth("y_cup"), 0.0, 0.002);
  EXPECT_EQ(rig.truth("z_cup"), kTop_m);
  EXPECT_NEAR(rig.truth("yaw_cup"), 0.3, 0.01);
  EXPECT_EQ(rig.contacts(), 0.0) << rig.incidents();
  EXPECT_EQ(rig.truth("dropped"), 0.0) << rig.incidents();
  EXPECT_EQ(rig.truth("slipped"), 0.0) << rig.incidents();
  EXPECT_LT(rig.truth("worst_tilt"), 0.1);
}

// Friction holds 2 * 0.4 * 20 N = 16 N; the cup weighs 1.962 N, which is 12.3 % of it.
TEST(RobotCell, WhenFrictionIsLost_ThenTheCupSlipsExactlyBelowItsWeightAndTheJudgeSaysWhereItFell) {
  Rig holds(cell({kCup}));
  lift_cup(holds);
  holds.fault("slip_left", 0.87);
  holds.run(1.0);
  EXPECT_EQ(holds.truth("held_left"), 1.0);
  EXPECT_EQ(holds.truth("slipped"), 0.0);

  Rig slips(cell({kCup}));
  lift_cup(slips);
  slips.fault("slip_left", 0.885);
  slips.run(2.0);
  EXPECT_EQ(slips.truth("held_left"), 0.0);
  EXPECT_EQ(slips.truth("slipped"), 1.0) << slips.incidents();
  EXPECT_EQ(slips.truth("dropped"), 1.0) << slips.incidents();
  EXPECT_EQ(slips.truth("on_cup"), 1.0);
  EXPECT_EQ(slips.truth("z_cup"), kTop_m);
  EXPECT_NE(slips.incidents().find("cup fell 0.1"), std::string::npos) << slips.incidents();
  EXPECT_NE(slips.incidents().find("m on table"), std::string::npos) << slips.incidents();
}

// 20 N/mm: a set point 0.2 mm below the cup's width presses with 4 N, which hold 3.2 N; 0.1 mm hold 1.6 N
// only.
TEST(RobotCell, WhenTheSetPointPressesTooLittle_ThenTheCupStaysWhereItStands) {
  for (const int opening : {698, 699}) {
    Rig rig(cell({kCup}));
    rig.go({0.5, 0.76}, 1.0);
    rig.grip(1e-4 * opening);
    EXPECT_EQ(rig.truth("held_left"), 1.0);
    rig.go({0.5, 0.95}, 2.0);
    EXPECT_EQ(rig.truth("held_left"), opening == 698 ? 1.0 : 0.0) << opening << rig.incidents();
    EXPECT_NEAR(rig.truth("z_cup"), opening == 698 ? kTop_m + 0.19 : kTop_m, 0.003) << opening;
    EXPECT_EQ(rig.truth("dropped"), 0.0) << opening;
  }
}

TEST(RobotCell, WhenACupIsSetDownOnABox_ThenItGoesAlongWithIt) {
  Rig rig(cell({kCup, {"box", ObjectKind::Box, 0.62, 0.0, 0.0, {}, 0.0}}));
  lift_cup(rig);
  rig.go({0.62, 0.95}, 1.0);
  rig.go({0.62, 0.84}, 1.0);
  rig.run(0.3);
  rig.grip(0.09);
  rig.go({0.62, 1.0}, 1.0);
  EXPECT_EQ(rig.truth("on_cup"), 101.0) << rig.incidents();
  EXPECT_NEAR(rig.truth("z_cup"), kTop_m + 0.08, 1e-12);
  EXPECT_EQ(rig.contacts(), 0.0) << rig.incidents();
  rig.fault("shift_y_box", 40.0);
  EXPECT_NEAR(rig.truth("y_cup"), 0.04, 0.001);
}

TEST(RobotCell, WhenAHandLosesTheCupBesideTheTable_ThenItLiesOnTheFloor) {
  Rig rig(cell({kCup}));
  lift_cup(rig);
  rig.go({0.25, 0.95}, 1.5);
  rig.fault("drop_left", 1.0);
  rig.run(1.0);
  EXPECT_EQ(rig.truth("on_cup"), 0.0);
  EXPECT_EQ(rig.truth("z_cup"), 0.0);
  EXPECT_NE(rig.incidents().find("m on floor"), std::string::npos) << rig.incidents();
}

TEST(RobotCell, WhenATrayIsCarried_ThenWhatStandsOnItGoesAlongAndSlidesOnlyBeyondFriction) {
  const ObjectFigures tray{"tray", ObjectKind::Tray, 0.5, 0.15, 0.5 * std::numbers::pi, {}, 0.0};
  const ObjectFigures on_it{"can", ObjectKind::Can, 0.5, 0.15, 0.0, {}, 0.0};
  Rig rig(cell({tray, on_it}));
  EXPECT_EQ(rig.truth("on_can"), 100.0);
  EXPECT_NEAR(rig.truth("z_can"), kTop_m + 0.015, 1e-12);
  rig.go({0.5, 0.745}, 1.0);  // the handle at y = 0
  rig.grip(0.01);
  EXPECT_EQ(rig.truth("held_left"), 1.0) << rig.incidents();
  EXPECT_NEAR(rig.truth("true_width_left"), 0.02, 1e-9);
  const double beside = rig.truth("y_can") - rig.truth("y_tray");
  rig.go({0.5, 0.90}, 1.5);
  rig.go({0.62, 0.90}, 1.5);
  EXPECT_NEAR(rig.truth("z_can") - rig.truth("z_tray"), 0.015, 1e-9);
  EXPECT_NEAR(rig.truth("x_can") - rig.truth("x_tray"), 0.0, 1e-6);
  EXPECT_NEAR(rig.truth("y_can") - rig.truth("y_tray"), beside, 1e-6);
  EXPECT_EQ(rig.truth("state_can"), 0.0);
  EXPECT_EQ(rig.contacts(), 0.0) << rig.incidents();
  // Far beyond what friction gives: it slides over the edge and falls.
  CellObjects objects(cell({tray, on_it}));
  objects.hold(0);
  objects.shake(0, {3.9, 0.0, 0.0}, 0.1);
  EXPECT_EQ(objects[1].pose.place.x, 0.5);
  objects.shake(0, {5.0, 0.0, 0.0}, 0.1);
  EXPECT_NEAR(objects[1].pose.place.x, 0.5 - 0.5 * (5.0 - 0.4 * 9.81) * 0.01, 1e-12);
}

TEST(RobotCell, WhenTwoHandsCarryATray_ThenOneThatGoesItsOwnWayLosesIt) {
  const ObjectFigures tray{"tray", ObjectKind::Tray, 0.5, -0.3, 0.5 * std::numbers::pi, {0.62, 0.2, 0.06},
                           0.0};
  Rig rig(cell({tray}, 2));
  const auto both = [&](robot_rig::InPlane from, robot_rig::InPlane to, bool left = true) {
    for (int k = 1; k <= 100; ++k) {
      const double s = 0.5 - 0.5 * std::cos(0.01 * std::numbers::pi * k);
      const robot_rig::InPlane at{from.x_m + s * (to.x_m - from.x_m), from.z_m + s * (to.z_m - from.z_m)};
      if (left) rig.point(0, at);
      rig.point(1, at);
      rig.run(0.01);
    }
  };
  both({0.5, 0.9}, {0.5, 0.745});
  rig.grip(0.01, 0);
  rig.grip(0.01, 1);
  both({0.5, 0.745}, {0.5, 0.9});
  both({0.5, 0.9}, {0.6, 0.9});
  EXPECT_EQ(rig.truth("held_left"), 1.0);
  EXPECT_EQ(rig.truth("held_right"), 1.0);
  EXPECT_NEAR(rig.truth("x_tray"), 0.6, 0.002);
  EXPECT_EQ(rig.contacts(), 0.0) << rig.incidents();
  EXPECT_EQ(rig.truth("slipped"), 0.0) << rig.incidents();
  both({0.6, 0.9}, {0.6, 1.0}, false);
  EXPECT_EQ(rig.truth("held_left"), 1.0);
  EXPECT_EQ(rig.truth("held_right"), 0.0);
  EXPECT_NE(rig.incidents().find("tray slipped in the hand of the right arm"), std::string::npos)
      << rig.incidents();
  EXPECT_EQ(rig.truth("dropped"), 0.0);
}

TEST(RobotCell, WhenObjectsAreStackedOrMoved_ThenTheyStandOnWhatIsBelowThem) {
  const ObjectFigures box{"box", ObjectKind::Box, 0.5, 0.3, 0.0, {}, 0.0};
  const ObjectFigures top{"top", ObjectKind::Box, 0.5, 0.3, 0.4, {}, 0.0};
  Rig rig(cell({box, top, kCup}));
  EXPECT_EQ(rig.truth("on_top"), 100.0);
  EXPECT_NEAR(rig.truth("z_top"), kTop_m + 0.08, 1e-12);
  rig.fault("shift_x_box", 50.0);
  rig.run(0.1);
  EXPECT_NEAR(rig.truth("x_top"), 0.55, 1e-9);
  rig.fault("shift_x_top", 100.0);  // off its box
  rig.run(0.5);
  EXPECT_EQ(rig.truth("on_top"), 1.0);
  const auto where = rig->judge().object_places(rig->objects());
  EXPECT_EQ(where[1].object + " on " + where[1].on, "top on table");
  rig.fault("shift_y_cup", 300.0);  // into the box
  rig.fault("shift_x_cup", 50.0);
  rig.run(0.1);
  EXPECT_EQ(rig.truth("contacts_object_object"), 1.0) << rig.incidents();
}

TEST(RobotCell, WhenTheArmsMeet_ThenBothStopOnceAndStayApart) {
  Rig rig(cell({}, 2));
  rig.run(0.1);
  EXPECT_NEAR(rig.truth("smallest_gap"), 0.6 - 0.16, 1e-3);
  for (int k = 1; k <= 200; ++k) {
    const double turn = 0.008 * k;
    rig.point(0, {0.5, 0.9}, -turn);
    rig.point(1, {0.5, 0.9}, turn);
    rig.run(0.01);
    if (rig.sensor("trip_left") == 1) break;
  }
  EXPECT_EQ(rig.truth("contacts_arm_arm"), 1.0) << rig.incidents();
  EXPECT_EQ(rig.sensor("trip_left"), 1);
  EXPECT_EQ(rig.sensor("trip_right"), 1);
  EXPECT_EQ(rig.truth("smallest_gap"), 0.0);
  const double stands = rig.truth("true_left_1");
  rig.run(0.5);
  EXPECT_EQ(rig.truth("true_left_1"), stands);
  EXPECT_EQ(rig.truth("contacts_arm_arm"), 1.0);
  for (const std::string name : {"left", "right"}) rig.set("enable_" + name, 0);
  rig.point(0, {0.5, 0.9}, rig.truth("true_left_1") + 0.1);
  rig.point(1, {0.5, 0.9}, rig.truth("true_right_1") - 0.1);
  rig.run(0.05);
  for (const std::string name : {"left", "right"}) rig.set("enable_" + name, 1);
  rig.run(0.5);
  EXPECT_EQ(rig.sensor("ready_left"), 1);
  EXPECT_GT(rig.truth("true_left_1"), stands + 0.05);
}

TEST(RobotCell, WhenAnArmRunsIntoThings_ThenFixedOnesStopItAndFreeOnesGiveWay) {
  Rig table(cell({}));
  table.go({0.5, 0.68}, 1.0);
  EXPECT_EQ(table.truth("contacts_arm_fixed"), 1.0);
  EXPECT_EQ(table.sensor("trip_left"), 1);
  RobotCellParameters parameters = cell({kCup});
  parameters.blockages = {{"crate", box_solid({0.1, 0.1, 0.3}), {{}, {0.62, 0.0, 0.85}}, false, false}};
  Rig rig(parameters);
  rig.fault("shift_x_cup", 60.0);
  rig.grip(0.0);
  rig.go({0.5, 0.76}, 1.0);
  rig.go({0.55, 0.76}, 1.0);
  EXPECT_GE(rig.truth("contacts_arm_object"), 1.0) << rig.incidents();
  EXPECT_EQ(rig.sensor("trip_left"), 0);
  EXPECT_GT(rig.truth("x_cup"), 0.565);
  rig.go({0.5, 0.9}, 1.0);
  rig.fault("block_1", 1.0);
  EXPECT_EQ(rig.truth("blocked_1"), 0.0) << "the cup is in its place";
  rig.fault("shift_y_cup", 300.0);
  rig.run(0.1);
  EXPECT_EQ(rig.truth("blocked_1"), 1.0);
  rig.go({0.6, 0.9}, 1.0);
  EXPECT_EQ(rig.sensor("trip_left"), 1);
  EXPECT_NE(rig.incidents().find("left arm and crate touched"), std::string::npos) << rig.incidents();
}

TEST(RobotCell, WhenDrivesFail_ThenTheArmTripsBrakesAndComesBackWithANewEnable) {
  for (const std::string name : {"stuck_left_2", "runaway_left_2", "overcurrent_left_2"}) {
    Rig rig(cell({}));
    rig.run(0.1);
    rig.fault(name, 1.0);
    rig.go({0.3, 1.2}, 2.0);
    EXPECT_EQ(rig.sensor("trip_left"), 1) << name;
    EXPECT_EQ(rig.sensor("ready_left"), 0) << name;
    const double stands = rig.truth("true_left_4");
    rig.run(0.5);
    EXPECT_NEAR(rig.truth("true_left_4"), stands, 1e-6) << name;
    ASSERT_TRUE(rig->clear_fault(name));
    rig.set("enable_left", 0);
    for (int k = 1; k <= 7; ++k)
      rig.set("set_left_" + std::to_string(k), rig.sensor("pos_left_" + std::to_string(k)));
    rig.run(0.1);
    rig.set("enable_left", 1);
    rig.run(0.1);
    EXPECT_EQ(rig.sensor("ready_left"), 1) << name;
  }
  Rig rig(cell({}));
  rig.fault("press_estop", 1.0);
  rig.go({0.45, 0.9}, 0.5);
  EXPECT_EQ(rig.sensor("estop_ok"), 0);
  EXPECT_NEAR(rig.truth("true_left_2"), robot_rig::angles_of({0.5, 0.9})[1], 1e-4);
}

TEST(RobotCell, WhenEnableIsLostOnTheWay_ThenTheArmBrakesAndTheHandGoesOnHolding) {
  Rig rig(cell({kCup}));
  lift_cup(rig);
  for (int k = 1; k <= 20; ++k) {  // 1 rad/s
    rig.point(0, {0.5, 0.95}, 0.01 * k);
    rig.run(0.01);
  }
  const double from = rig.truth("true_left_1");
  rig.set("enable_left", 0);
  rig.run(0.01);
  EXPECT_EQ(rig.sensor("ready_left"), 0);
  rig.run(0.5);
  EXPECT_NEAR(rig.truth("true_left_1") - from, 1.0 / (2.0 * 30.0), 0.01);
  const double stands = rig.truth("true_left_1");
  rig.run(0.5);
  EXPECT_NEAR(rig.truth("true_left_1"), stands, 1e-5);
  EXPECT_EQ(rig.truth("held_left"), 1.0);
  EXPECT_EQ(rig.sensor("trip_left"), 0);
}

TEST(RobotCell, WhenFaultsAreWrong_ThenTheyAreRefused) {
  Rig rig(cell({kCup}, 2));
  const auto code = [&](const std::string& name, double value) {
    const auto injected = rig->inject_fault(name, value);
    return injected ? std::string() : injected.error().front().code;
  };
  EXPECT_EQ(code("stuck_left_8", 1.0), "C0311");
  EXPECT_EQ(code("runaway_left_1", 9.0), "C0312");
  EXPECT_EQ(code("camera_ghosts", 1.5), "C0312");
  EXPECT_EQ(code("shift_x_cup", std::numeric_limits<double>::quiet_NaN()), "C0312");
  for (const core::Quantity& fault : rig->faults()) {
    EXPECT_EQ(code(fault.name, 0.0), "") << fault.name;
    EXPECT_TRUE(rig->clear_fault(fault.name));
  }
  std::set<std::string> names;
  for (const auto& port : rig->actuators()) EXPECT_TRUE(names.insert(port.name).second) << port.name;
  for (const auto& port : rig->sensors()) EXPECT_TRUE(names.insert(port.name).second) << port.name;
}

// Commands that are the same function of time, in slices of their own.
std::vector<std::uint64_t> hashes(std::uint64_t seed, int slices) {
  RobotCellParameters parameters = cell({kCup, {"can", ObjectKind::Can, 0.6, 0.3, 0.0, {}, 0.0}}, 2);
  parameters.seed = seed;
  Rig rig(parameters);
  std::vector<std::uint64_t> found;
  for (int scan = 0; scan < 150; ++scan) {
    rig.point(0, {0.5 + 0.0005 * scan, 0.9 - 0.0008 * scan});
    rig.set("camera_trigger", scan / 20 % 2);
    rig.set("grip_left", scan > 100 ? 500 : 900);
    for (int k = 1; k <= slices; ++k)
      rig->advance_to(std::chrono::microseconds(10'000 * scan + 10'000 * k / slices));
    found.push_back(rig->state_hash());
  }
  return found;
}

TEST(RobotCell, WhenRepeated_ThenEveryBitIsTheSameForASeedHoweverTimeIsSliced) {
  const auto once = hashes(3, 1);
  EXPECT_EQ(once, hashes(3, 1));
  EXPECT_EQ(once, hashes(3, 4));
  EXPECT_NE(once, hashes(4, 1));
}

TEST(RobotCell, WhenACellIsResumed_ThenItIsWhereItWasAndGoesOn) {
  RobotCellParameters parameters = cell({kCup, {"box", ObjectKind::Box, 0.6, 0.3, 0.2, {}, 0.0}}, 2);
  Rig first(parameters);
  lift_cup(first);
  first.run(1.0);
  const std::vector<double> kept = first.kept();
  Rig second(parameters);
  ASSERT_TRUE(second->resume(kept));
  EXPECT_EQ(second.kept(), kept);
  second.set("grip_left", 600);
  for (int k = 0; k < 7; ++k)
    second.set("set_left_" + std::to_string(k + 1), first.sensor("pos_left_" + std::to_string(k + 1)));
  for (Rig* rig : {&first, &second}) rig->run(1.0);
  EXPECT_EQ(second.truth("held_left"), 1.0);
  EXPECT_NEAR(second.truth("z_cup"), first.truth("z_cup"), 1e-3);
  second.set("grip_left", 900);
  second.run(1.0);
  EXPECT_EQ(second.truth("on_cup"), 1.0);
  EXPECT_EQ(second.truth("dropped"), 1.0);
  // What cannot have been kept is refused and changes nothing.
  const std::vector<double> before = second.kept();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    std::vector<double> wrong = kept;
    wrong[k] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(second->resume(wrong)) << k;
  }
  std::vector<double> wrong = kept;
  wrong.back() = 5e5;  // stands on what is not there
  EXPECT_FALSE(second->resume(wrong));
  wrong = kept;
  wrong[0] = 4.0;  // beyond the joint's limits
  EXPECT_FALSE(second->resume(wrong));
  EXPECT_FALSE(second->resume(std::span(kept).first(kept.size() - 1)));
  EXPECT_EQ(second.kept(), before);
}

// Whatever is taken for a kept state is refused, or the cell goes on from it.
TEST(RobotCell, WhenKeptNumbersAreDamaged_ThenTheCellRefusesThemOrGoesOn) {
  const RobotCellParameters parameters = cell({kCup, {"box", ObjectKind::Box, 0.6, 0.3, 0.2, {}, 0.0}}, 2);
  Rig rig(parameters);
  lift_cup(rig);
  const std::vector<double> kept = rig.kept();
  const core::CounterRandom random(7, 1);
  int taken = 0;
  for (std::uint64_t round = 0; round < 60; ++round) {
    std::vector<double> damaged = kept;
    for (std::uint64_t k = 0; k < 3; ++k) {
      const std::uint64_t bits = random.bits(8 * round + k);
      const double values[] = {0.0, 1.0, 2.0, 100.0, 101.0, 3.0 * random.symmetric(8 * round + k + 4)};
      damaged[bits % damaged.size()] = values[bits / 1024 % 6];
    }
    if (!rig->resume(damaged)) continue;
    ++taken;
    rig.run(0.1);
    for (std::uint32_t k = 0; k < rig->truths().size(); ++k)
      ASSERT_TRUE(std::isfinite(rig->truth(core::TruthId(k)))) << rig->truths()[k].name;
  }
  EXPECT_GT(taken, 10);
}

// As many as a runtime can publish (host::kMaxPlantValues).
TEST(RobotCell, WhenItIsAsLargeAsItCanBe_ThenItsTruthsArePublished) {
  std::vector<ObjectFigures> objects;
  for (int row = 0; row < 4; ++row)
    for (int k = 0; k < 4; ++k)
      objects.push_back(
          {"o" + std::to_string(4 * row + k), ObjectKind::Cup, 0.4 + 0.1 * k, -0.2 + 0.1 * row, 0, {}, 0});
  RobotCellParameters parameters = cell(objects, 2);
  parameters.blockages.assign(4, parameters.fixed[0]);
  const auto made = RobotCell::create(parameters);
  ASSERT_TRUE(made) << result::to_string(made.error());
  EXPECT_LE((*made)->truths().size(), 128u);
  Rig rig(parameters);
  rig.go({0.55, 1.0}, 1.0);
  EXPECT_EQ(rig.contacts(), 0.0) << rig.incidents();
  parameters.objects.push_back({"one_more", ObjectKind::Cup, 0.5, 0.9, 0, {}, 0});
  EXPECT_FALSE(RobotCell::create(parameters));
}

TEST(RobotCell, WhenRunning_ThenNothingIsAllocated) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns the allocator";
  Rig rig(cell({kCup}, 2));
  lift_cup(rig);
  const auto trigger = *core::find_actuator(rig.plant(), "camera_trigger");
  const auto joint = *core::find_actuator(rig.plant(), "set_left_1");
  ASSERT_TRUE(rig->inject_fault("drop_left", 1.0));
  const support::GuardCounts before = support::guard_counts();
  for (int scan = 0; scan < 200; ++scan) {
    rig->set_actuator(trigger, static_cast<std::int16_t>(scan % 2));
    rig->set_actuator(joint, static_cast<std::int16_t>(10 * scan));
    rig->advance(std::chrono::milliseconds(10));
    for (std::uint32_t k = 0; k < rig->truths().size(); ++k) rig->truth(core::TruthId(k));
    for (std::uint32_t k = 0; k < rig->sensors().size(); ++k) rig->sensor(core::SensorId(k));
  }
  EXPECT_EQ(support::guard_counts(), before);
  EXPECT_EQ(rig.truth("dropped"), 1.0);
}

TEST(RobotCell, WhenFiguresMakeNoSense_ThenEachIsNamed) {
  RobotCellParameters parameters = cell({kCup, kCup});
  parameters.drive.time_constant_s = 0.0;
  parameters.hand.friction = std::numeric_limits<double>::quiet_NaN();
  parameters.camera.loss = 1.5;
  parameters.arms[0].joints[2].axis = {0, 0, 2};
  parameters.arms[0].start_rad[0] = 4.0;
  const auto made = RobotCell::create(parameters);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().size(), 6u) << result::to_string(made.error());
  for (const auto& problem : made.error()) EXPECT_EQ(problem.code, "C0321");
  parameters.arms.clear();
  EXPECT_FALSE(RobotCell::create(parameters));
}

}  // namespace
}  // namespace stepwright::assemblies

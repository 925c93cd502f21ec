#include "plant_models/assemblies/fleet_floor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/malloc_guard.h"

namespace stepwright::assemblies {
namespace {

using namespace std::chrono_literals;

FleetParameters quiet(std::vector<ForkliftPose> starts) {
  FleetParameters parameters;
  parameters.starts = std::move(starts);
  parameters.noise = FleetNoise::none();
  parameters.forklift.slip = {.drive_slip = 0.0, .understeer_s2_m2 = 0.0, .load_understeer_s2_m2_kg = 0.0};
  return parameters;
}

// Terminals and truths by name.
class Floor {
 public:
  explicit Floor(const FleetParameters& parameters) : plant_(FleetFloor::create(parameters).value()) {}

  FleetFloor& operator*() { return *plant_; }
  FleetFloor* operator->() { return plant_.get(); }
  void set(const std::string& name, int value) {
    plant_->set_actuator(*core::find_actuator(*plant_, name), static_cast<std::int16_t>(value));
  }
  void drive(const std::string& vehicle, int speed_mm_s, int lock_centidegrees = 0) {
    set("enable_" + vehicle, 1);
    set("set_speed_" + vehicle, speed_mm_s);
    set("set_lock_" + vehicle, lock_centidegrees);
  }
  void run(std::chrono::milliseconds time) { ASSERT_EQ(plant_->advance(time), core::PlantStatus::Good); }
  int sensor(const std::string& name) { return plant_->sensor(*core::find_sensor(*plant_, name)); }
  double truth(const std::string& name) { return plant_->truth(*core::find_truth(*plant_, name)); }
  void fault(const std::string& name, double value) { ASSERT_TRUE(plant_->inject_fault(name, value)); }

 private:
  std::unique_ptr<FleetFloor> plant_;
};

TEST(FleetFloor, WhenAVehicleDrives_ThenItsSensorsShowWhereItIs) {
  FleetParameters parameters = quiet({{1.0, 2.0, 0.5}, {20.0, 20.0, -3.0}});
  parameters.forklift.drive.drive_force_n = 1e6;  // only its lag of 0.3 s costs way
  Floor floor(parameters);
  floor.drive("v1", 1000);
  floor.run(5s);
  EXPECT_EQ(floor.sensor("x_v1"), std::lround(100.0 * floor.truth("true_x_v1")));
  EXPECT_EQ(floor.sensor("y_v1"), std::lround(100.0 * floor.truth("true_y_v1")));
  EXPECT_EQ(floor.sensor("heading_v1"), std::lround(0.5 * 18000.0 / std::acos(-1.0)));
  EXPECT_EQ(floor.sensor("speed_v1"), 1000);
  EXPECT_NEAR(std::hypot(floor.truth("true_x_v1") - 1.0, floor.truth("true_y_v1") - 2.0), 4.7, 1e-3);
  EXPECT_EQ(floor.sensor("x_v2"), 2000);  // nobody enabled it
  EXPECT_EQ(floor.sensor("bumper_v1"), 0);
}

TEST(FleetFloor, WhenSensorsAreNoisy_ThenTheirErrorHasTheGivenDeviation) {
  FleetParameters parameters = quiet({{5.0, 5.0, 1.0}});
  parameters.noise.position_m = 0.05;
  Floor floor(parameters);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kReadings = 4000;
  for (int k = 0; k < kReadings; ++k) {
    floor.run(10ms);
    const double error_cm = floor.sensor("x_v1") - 500.0;
    sum += error_cm;
    squares += error_cm * error_cm;
  }
  EXPECT_NEAR(sum / kReadings, 0.0, 0.4);
  EXPECT_NEAR(std::sqrt(squares / kReadings), 5.0, 0.3);
}

TEST(FleetFloor, WhenAVehicleRunsIntoAWall_ThenItStopsThereAndWaitsForEnableToBeTakenAway) {
  FleetParameters parameters = quiet({{0.0, 0.0, std::acos(-1.0)}});
  parameters.walls = {{{{0.5, 10.0}}, {{6.0, 0.0}, 0.0}}};  // from x = 5.75 m
  Floor floor(parameters);
  floor.drive("v1", -1200);  // backwards, along +x
  floor.run(10s);
  EXPECT_EQ(floor.sensor("bumper_v1"), 1);
  EXPECT_EQ(floor.truth("contacts"), 1.0);
  EXPECT_GT(floor.truth("greatest_force"), 1000.0);
  EXPECT_NEAR(floor.truth("true_x_v1") + parameters.forklift.body.rear_m, 5.75, 0.03);
  EXPECT_NEAR(floor.truth("true_speed_v1"), 0.0, 1e-6);
  floor.drive("v1", 1000);
  floor.run(2s);
  EXPECT_NEAR(floor.truth("true_x_v1") + parameters.forklift.body.rear_m, 5.75, 0.03);  // still held
  floor.set("enable_v1", 0);
  floor.run(20ms);
  floor.drive("v1", 1000);
  floor.run(3s);
  EXPECT_LT(floor.truth("true_x_v1"), 2.0);
  EXPECT_EQ(floor.sensor("bumper_v1"), 0);
  EXPECT_EQ(floor.truth("contacts"), 1.0);
}

TEST(FleetFloor, WhenTwoVehiclesMeet_ThenBothFeelIt) {
  Floor floor(quiet({{0.0, 0.0, std::acos(-1.0)}, {12.0, 0.0, 0.0}}));  // back to back
  floor.drive("v1", -1000);
  floor.drive("v2", -1000);
  floor.run(10s);
  EXPECT_EQ(floor.sensor("bumper_v1"), 1);
  EXPECT_EQ(floor.sensor("bumper_v2"), 1);
  EXPECT_NEAR(floor.truth("true_x_v2") - floor.truth("true_x_v1"), 2.0 * 2.4, 0.05);
}

TEST(FleetFloor, WhenAPalletIsLifted_ThenItGoesWithTheVehicleAndStaysWhereItIsPut) {
  FleetParameters parameters = quiet({{0.0, 0.0, 0.0}});
  parameters.pallets = {{{{4.0, 0.05}, 0.02}, 800.0}};
  Floor floor(parameters);
  floor.drive("v1", 1000);
  for (int k = 0; k < 1000 && floor.truth("true_x_v1") < 2.6; ++k) floor.run(10ms);
  floor.drive("v1", 0);
  floor.run(3s);
  ASSERT_EQ(floor.sensor("bumper_v1"), 0);
  floor.set("lift_v1", 1);
  floor.run(3s);
  ASSERT_EQ(floor.sensor("loaded_v1"), 1);
  EXPECT_EQ(floor.sensor("lifted_v1"), 1);
  EXPECT_EQ(floor.truth("state_p1"), 2.0);
  floor.drive("v1", -1000, 1000);
  floor.run(8s);
  floor.drive("v1", 0);
  floor.run(3s);
  const double x_m = floor.truth("x_p1");
  const double y_m = floor.truth("y_p1");
  EXPECT_NEAR(std::hypot(x_m - floor.truth("true_x_v1"), y_m - floor.truth("true_y_v1")), 0.95, 0.4);
  EXPECT_GT(std::hypot(x_m - 4.0, y_m), 3.0);
  floor.set("lift_v1", 0);
  floor.run(3s);
  EXPECT_EQ(floor.sensor("loaded_v1"), 0);
  EXPECT_EQ(floor.sensor("lowered_v1"), 1);
  floor.drive("v1", -1000);
  floor.run(5s);
  EXPECT_NEAR(floor.truth("x_p1"), x_m, 1e-3);
  EXPECT_NEAR(floor.truth("y_p1"), y_m, 1e-3);
  EXPECT_EQ(floor.truth("contacts"), 0.0);
}

TEST(FleetFloor, WhenAPalletIsTooHeavyOrOutOfReach_ThenItStays) {
  FleetParameters parameters = quiet({{0.0, 0.0, 0.0}, {0.0, 10.0, 0.0}});
  parameters.pallets = {{{{0.95, 0.0}, 0.0}, 5000.0}, {{{0.95, 10.5}, 0.0}, 500.0}};
  Floor floor(parameters);
  floor.set("lift_v1", 1);
  floor.set("lift_v2", 1);
  floor.run(3s);
  EXPECT_EQ(floor.sensor("loaded_v1"), 0);
  EXPECT_EQ(floor.sensor("loaded_v2"), 0);
  EXPECT_EQ(floor.truth("state_p2"), 1.0);
}

TEST(FleetFloor, WhenTheEmergencyStopIsPressed_ThenEveryVehicleStands) {
  Floor floor(quiet({{0.0, 0.0, 0.0}, {0.0, 10.0, 0.0}}));
  floor.drive("v1", 1500);
  floor.drive("v2", -1500);
  floor.run(6s);
  floor.fault("press_estop", 1);
  floor.run(2s);
  EXPECT_EQ(floor.sensor("estop_ok"), 0);
  EXPECT_NEAR(floor.truth("true_speed_v1"), 0.0, 1e-4);
  EXPECT_NEAR(floor.truth("true_speed_v2"), 0.0, 1e-4);
  floor.fault("press_estop", 0);
  floor.run(3s);
  EXPECT_GT(floor.truth("true_speed_v1"), 1.0);
}

TEST(FleetFloor, WhenFaultsHold_ThenTheyDoWhatTheyAreCalled) {
  FleetParameters parameters = quiet({{0.0, 0.0, 0.0}, {0.0, 10.0, 0.0}, {0.0, 20.0, 0.0}, {0.0, 30.0, 0.0}});
  parameters.blockages = {{{{0.4, 3.0}}, {{4.0, 30.0}, 0.0}}};
  Floor floor(parameters);
  for (const char* vehicle : {"v1", "v2", "v3", "v4"}) floor.drive(vehicle, 1000, 500);
  floor.fault("dead_v1", 1);
  floor.fault("slip_v2", 0.5);
  floor.fault("frozen_pose_v2", 1);
  floor.fault("stuck_steering_v3", 1);
  floor.fault("drift_v3", 2);
  EXPECT_EQ(floor.truth("blocked_1"), 0.0);
  floor.fault("block_1", 1);
  floor.run(6s);
  EXPECT_EQ(floor.truth("blocked_1"), 1.0);
  EXPECT_EQ(floor.truth("true_x_v1"), 0.0);
  EXPECT_EQ(floor.sensor("x_v1"), 0);
  EXPECT_NEAR(floor.truth("true_speed_v2"), 0.5, 1e-3);
  EXPECT_EQ(floor.sensor("x_v2"), 0);
  EXPECT_NEAR(floor.truth("true_heading_v3"), 0.0, 1e-9);
  EXPECT_NEAR(floor.sensor("x_v3") - 100.0 * floor.truth("true_x_v3"), 12.0, 1.0);
  EXPECT_EQ(floor.sensor("bumper_v4"), 1);
  ASSERT_TRUE(floor->clear_fault("frozen_pose_v2"));
  EXPECT_GT(floor.sensor("x_v2"), 100);
}

TEST(FleetFloor, WhenAFaultIsWrong_ThenTheMessageSaysWhatThereIs) {
  Floor floor(quiet({{0.0, 0.0, 0.0}}));
  EXPECT_EQ(floor->inject_fault("leak_a1", 1.0).error().front().code, "C0311");
  EXPECT_EQ(floor->inject_fault("slip_v1", 2.0).error().front().code, "C0312");
  EXPECT_EQ(floor->clear_fault("dead_v9").error().front().code, "C0311");
}

TEST(FleetFloor, WhenFiguresMakeNoSense_ThenEachIsNamed) {
  FleetParameters parameters = quiet({{400.0, 0.0, 0.0}});
  parameters.pallets = {{{{0.0, 0.0}, 0.0}, -1.0}};
  parameters.walls = {{{{0.0, 1.0}}, {{0.0, 0.0}, 0.0}}};
  const auto floor = FleetFloor::create(parameters);
  ASSERT_FALSE(floor);
  EXPECT_EQ(floor.error().size(), 3u) << result::to_string(floor.error());
  EXPECT_FALSE(FleetFloor::create(quiet({})));
}

FleetParameters busy(std::uint64_t seed) {
  FleetParameters parameters;
  parameters.seed = seed;
  for (int k = 0; k < 4; ++k) parameters.starts.push_back({3.0 * k, 1.0 * k, 0.7 * k});
  parameters.pallets = {{{{6.0, 3.0}, 0.3}, 500.0}, {{{2.0, 5.0}, 1.0}, 700.0}};
  parameters.walls = {{{{0.3, 30.0}}, {{16.0, 0.0}, 0.1}}, {{{0.3, 30.0}}, {{-9.0, 0.0}, 0.0}}};
  return parameters;
}

// Drives about, into each other and the walls; each scan of 10 ms is advanced in `slices` parts.
std::uint64_t trace(std::uint64_t seed, int slices) {
  Floor floor(busy(seed));
  std::uint64_t hash = 0;
  for (int scan = 0; scan < 1500; ++scan) {
    for (int v = 1; v <= 4; ++v) {
      const std::string name = "v" + std::to_string(v);
      floor.drive(name, 1400 - 400 * ((scan / 200 + v) % 7), 100 * ((scan / 50) % 9) - 400);
      floor.set("enable_" + name, scan % 300 != 0);
      floor.set("lift_" + name, (scan / 400) % 2);
    }
    for (int k = 1; k <= slices; ++k) floor->advance_to(scan * 10ms + 10ms * k / slices);
    for (std::uint32_t s = 0; s < floor->sensors().size(); ++s) {
      hash = hash * 31 + static_cast<std::uint64_t>(floor->sensor(core::SensorId(s)));
    }
  }
  EXPECT_GT(floor.truth("contacts"), 0.0);
  return hash ^ floor->state_hash();
}

TEST(FleetFloor, WhenSeedAndInputsAreEqual_ThenEveryBitIs) {
  EXPECT_EQ(trace(3, 1), trace(3, 1));
  EXPECT_EQ(trace(3, 1), trace(3, 3));
  EXPECT_NE(trace(3, 1), trace(4, 1));
}

TEST(FleetFloor, WhenItIsKept_ThenAnotherFloorGoesOnFromThere) {
  FleetParameters parameters = quiet({{0.0, 0.0, 0.0}, {0.0, 10.0, 1.0}});
  parameters.pallets = {{{{0.95, 0.0}, 0.0}, 500.0}, {{{5.0, 5.0}, 0.4}, 500.0}};
  Floor before(parameters);
  before.set("lift_v1", 1);
  before.drive("v2", 1000);
  before.run(5s);
  std::vector<double> kept(before->kept_size());
  before->keep(kept);
  Floor after(parameters);
  ASSERT_TRUE(after->resume(kept));
  EXPECT_EQ(after.sensor("loaded_v1"), 1);
  EXPECT_EQ(after.truth("state_p1"), 2.0);
  EXPECT_NEAR(after.truth("true_x_v2"), before.truth("true_x_v2"), 1e-12);
  EXPECT_NEAR(after.truth("true_speed_v2"), 0.0, 1e-12);
  std::vector<double> again(after->kept_size());
  after->keep(again);
  for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_NEAR(again[i], kept[i], 1e-5) << i;
  for (std::size_t wrong = 0; wrong < kept.size(); ++wrong) {
    std::vector<double> broken = kept;
    broken[wrong] = std::nan("");
    EXPECT_FALSE(Floor(parameters)->resume(broken)) << wrong;
  }
  kept[11] = 2.0;  // carried by a vehicle whose forks are down
  EXPECT_FALSE(Floor(parameters)->resume(kept));
}

TEST(FleetFloor, WhenRunning_ThenNothingIsAllocated) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns the allocator";
  Floor floor(busy(1));
  for (int v = 1; v <= 4; ++v) floor.drive("v" + std::to_string(v), 1200, 300);
  floor.run(100ms);
  const support::GuardCounts before = support::guard_counts();
  for (int scan = 0; scan < 1000; ++scan) floor->advance(10ms);
  EXPECT_EQ(support::guard_counts(), before);
}

}  // namespace
}  // namespace stepwright::assemblies

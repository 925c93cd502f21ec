#include "plant_models/assemblies/tugger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/malloc_guard.h"

namespace stepwright::assemblies {
namespace {

using namespace std::chrono_literals;
using body2d::Vec2;

std::vector<Vec2> block(Vec2 low, Vec2 high) {
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

// A hall of 40 x 20 m with a pillar and two docks; the train stands in its middle and looks along x.
TuggerParameters hall(std::size_t trailers = 3) {
  TuggerParameters parameters;
  parameters.trailers = trailers;
  parameters.noise = TuggerNoise::none();
  parameters.slip = TuggerSlip::none();
  parameters.start = {{20.0, 10.0}, 0.0};
  parameters.walls = {{"border", block({0, 0}, {40, 20})}};
  parameters.obstacles = {{"pillar", {{30, 9}, {31, 10}, {30, 11}}}};
  parameters.places = {{"dock", block({24, 8}, {26, 12})}, {"store", block({2, 2}, {6, 6})}};
  parameters.blockages = {{"block_1", block({26, 9}, {27, 11})}, {"block_2", block({18.5, 9}, {19.0, 11})}};
  return parameters;
}

// Terminals and truths by name.
class Rig {
 public:
  explicit Rig(const TuggerParameters& parameters) : plant_(Tugger::create(parameters).value()) {}

  Tugger* operator->() { return plant_.get(); }
  void set(const std::string& name, int value) {
    plant_->set_actuator(*core::find_actuator(*plant_, name), static_cast<std::int16_t>(value));
  }
  void drive(int speed_mm_s, int lock_centidegrees = 0) {
    set("enable", 1);
    set("set_speed", speed_mm_s);
    set("set_lock", lock_centidegrees);
  }
  void run(std::chrono::milliseconds time) { ASSERT_EQ(plant_->advance(time), core::PlantStatus::Good); }
  int sensor(const std::string& name) { return plant_->sensor(*core::find_sensor(*plant_, name)); }
  double truth(const std::string& name) { return plant_->truth(*core::find_truth(*plant_, name)); }
  void fault(const std::string& name, double value) {
    const auto injected = plant_->inject_fault(name, value);
    ASSERT_TRUE(injected) << result::to_string(injected.error());
  }
  std::string refused(const std::string& name, double value) {
    const auto injected = plant_->inject_fault(name, value);
    return injected ? "" : injected.error().front().code;
  }

 private:
  std::unique_ptr<Tugger> plant_;
};

TEST(Tugger, WhenItDrives_ThenItsSensorsShowWhereItIsAndHowItBends) {
  Rig rig(hall());
  rig.drive(1000, 2000);
  rig.run(4s);
  EXPECT_EQ(rig.sensor("x"), std::lround(100.0 * rig.truth("true_x")));
  EXPECT_EQ(rig.sensor("y"), std::lround(100.0 * rig.truth("true_y")));
  EXPECT_EQ(rig.sensor("speed"), 1000);
  EXPECT_EQ(rig.sensor("lock"), 2000);
  EXPECT_EQ(rig.sensor("trailers"), 3);
  const double degrees = 18'000.0 / std::acos(-1.0);
  EXPECT_EQ(rig.sensor("heading"), std::lround(degrees * rig.truth("true_heading")));
  EXPECT_EQ(rig.sensor("hitch_1"),
            std::lround(degrees * (rig.truth("true_heading") - rig.truth("true_heading_1"))));
  EXPECT_EQ(rig.sensor("hitch_3"),
            std::lround(degrees * (rig.truth("true_heading_2") - rig.truth("true_heading_3"))));
  EXPECT_GT(rig.sensor("hitch_1"), 500);
  EXPECT_NEAR(
      std::hypot(rig.truth("true_x") - rig.truth("true_x_1"), rig.truth("true_y") - rig.truth("true_y_1")),
      1.0, 1e-9);
  EXPECT_EQ(rig.sensor("bumper"), 0);
  EXPECT_EQ(rig.truth("contacts"), 0.0);
}

TEST(Tugger, WhenSensorsAreNoisy_ThenTheirErrorsHaveTheGivenDeviationAndAreTheirOwn) {
  TuggerParameters parameters = hall(2);
  parameters.noise.position_m = 0.05;
  parameters.noise.hitch_rad = 0.02;
  Rig rig(parameters);
  double squares = 0.0;
  double hitch_squares = 0.0;
  double together = 0.0;
  constexpr int kReadings = 4000;
  for (int k = 0; k < kReadings; ++k) {
    rig.run(10ms);
    squares += std::pow(rig.sensor("x") - 2000.0, 2);
    hitch_squares += std::pow(rig.sensor("hitch_1"), 2);
    together += rig.sensor("hitch_1") * rig.sensor("hitch_2");
  }
  EXPECT_NEAR(std::sqrt(squares / kReadings), 5.0, 0.3);
  EXPECT_NEAR(std::sqrt(hitch_squares / kReadings), 0.02 * 18'000.0 / std::acos(-1.0), 6.0);
  EXPECT_NEAR(together / hitch_squares, 0.0, 0.06);
}

TEST(Tugger, WhenItRunsIntoTheWall_ThenItStopsBeforeItAndWaitsForEnableToBeTakenAway) {
  TuggerParameters parameters = hall();
  parameters.obstacles.clear();
  Rig rig(parameters);
  rig.drive(2000);
  rig.run(15s);
  EXPECT_EQ(rig.sensor("bumper"), 1);
  EXPECT_EQ(rig.truth("contacts"), 1.0);
  EXPECT_EQ(rig.truth("smallest_gap"), 0.0);
  const double x_m = rig.truth("true_x");
  EXPECT_LE(x_m + 0.45, 40.0 + 1e-9);
  EXPECT_GT(x_m + 0.45, 40.0 - 0.021);
  EXPECT_EQ(rig.truth("true_speed"), 0.0);
  rig.drive(-1000);
  rig.run(2s);
  EXPECT_EQ(rig.truth("true_x"), x_m);  // still held
  rig.set("enable", 0);
  rig.run(20ms);
  EXPECT_EQ(rig.sensor("bumper"), 0);
  rig.drive(-1000);
  rig.run(3s);
  EXPECT_LT(rig.truth("true_x"), x_m - 1.5);
  EXPECT_EQ(rig.truth("contacts"), 1.0);
}

TEST(Tugger, WhenItPassesAnObstacle_ThenTheLeastDistanceIsKept) {
  TuggerParameters parameters = hall(1);
  parameters.start = {{20.0, 12.0}, 0.0};  // its side is at 11.75, the pillar ends at 11
  Rig rig(parameters);
  rig.drive(2000);
  rig.run(8s);
  EXPECT_NEAR(rig.truth("smallest_gap"), 0.75, 1e-6);
  EXPECT_EQ(rig.truth("contacts"), 0.0);
}

TEST(Tugger, WhenOnlyATrailerMeetsSomething_ThenTheTrainFeelsItToo) {
  TuggerParameters parameters = hall(4);
  parameters.obstacles = {{"post", block({21.0, 11.2}, {21.2, 11.4})}};
  parameters.start = {{20.0, 10.0}, 0.0};
  Rig rig(parameters);
  rig.drive(1000, 3000);  // around the post, which the trailers cut
  rig.run(12s);
  EXPECT_EQ(rig.sensor("bumper"), 1);
  EXPECT_EQ(rig.truth("contacts"), 1.0);
  const FloorOutline post(parameters.obstacles[0].ring);
  EXPECT_GT(distance_m(rig->train().boxes()[0], post, 1.0), 0.1);
  EXPECT_LT(distance_m(rig->train().boxes()[1], post, 1.0), 0.03);
}

TEST(Tugger, WhenItBitesItsTail_ThenThatIsAContactAndNeighboursAreNone) {
  TuggerParameters parameters = hall(8);
  parameters.most_trailers = 8;
  parameters.obstacles.clear();
  Rig rig(parameters);
  rig.drive(1000, 4000);  // a circle of 1.2 m is shorter than the train
  rig.run(15s);
  EXPECT_EQ(rig.sensor("bumper"), 1);
  EXPECT_EQ(rig.truth("contacts"), 1.0);
}

TEST(Tugger, WhenAPlaceIsBlocked_ThenTheScannerSeesItAndTheTrainStopsAtIt) {
  Rig rig(hall());
  EXPECT_EQ(rig.sensor("way_free"), 1);
  rig.fault("block_1", 1);
  EXPECT_EQ(rig.truth("blocked_1"), 1.0);
  EXPECT_EQ(rig.sensor("way_free"), 1);  // 6 m away
  rig.drive(1000);
  for (int k = 0; k < 1000 && rig.sensor("way_free") == 1; ++k) rig.run(10ms);
  EXPECT_NEAR(rig.truth("true_x"), 26.0 - 2.5 - 0.45, 0.02);
  rig.run(8s);
  EXPECT_EQ(rig.sensor("bumper"), 1);
  EXPECT_NEAR(rig.truth("true_x"), 26.0 - 0.45, 0.02);
  ASSERT_TRUE(rig->clear_fault("block_1"));
  EXPECT_EQ(rig.sensor("way_free"), 1);  // the pillar behind it does not count
  rig.set("enable", 0);
  rig.run(20ms);
  rig.drive(1000);
  rig.run(2s);
  EXPECT_GT(rig.truth("true_x"), 26.5);
  EXPECT_EQ(rig.truth("contacts"), 1.0);
}

TEST(Tugger, WhenSomethingAppearsOnTheTrain_ThenItIsOneContactUntilItIsGone) {
  Rig rig(hall());
  rig.drive(500);
  rig.run(500ms);
  rig.fault("block_2", 1);
  rig.run(1s);
  EXPECT_EQ(rig.sensor("bumper"), 1);
  rig.set("enable", 0);
  rig.run(100ms);
  rig.drive(500);
  rig.run(1s);
  EXPECT_EQ(rig.truth("contacts"), 1.0);
  EXPECT_EQ(rig.sensor("bumper"), 1);
  rig.fault("block_2", 0);
  rig.set("enable", 0);
  rig.run(100ms);
  rig.drive(500);
  rig.run(1s);
  EXPECT_EQ(rig.sensor("bumper"), 0);
}

TEST(Tugger, WhenTheReferencePointIsInAPlace_ThenItsLoopTells) {
  Rig rig(hall());
  EXPECT_EQ(rig.sensor("at_dock"), 0);
  rig.drive(1000);
  for (int k = 0; k < 1000 && rig.sensor("at_dock") == 0; ++k) rig.run(10ms);
  EXPECT_NEAR(rig.truth("true_x"), 24.0, 0.011);
  for (int k = 0; k < 1000 && rig.sensor("at_dock") == 1; ++k) rig.run(10ms);
  EXPECT_NEAR(rig.truth("true_x"), 26.0, 0.011);
  EXPECT_EQ(rig.sensor("at_store"), 0);
}

TEST(Tugger, WhenFaultsHold_ThenTheyDoWhatTheyAreCalled) {
  Rig dead(hall());
  dead.drive(1000);
  dead.fault("dead", 1);
  dead.run(2s);
  EXPECT_EQ(dead.truth("true_x"), 20.0);
  EXPECT_EQ(dead.sensor("x"), 0);
  EXPECT_EQ(dead.sensor("estop_ok"), 1);

  Rig slips(hall());
  slips.drive(1000, 500);
  slips.fault("slip", 0.5);
  slips.fault("frozen_pose", 1);
  slips.fault("stuck_steering", 1);
  slips.run(4s);
  EXPECT_NEAR(slips.truth("true_speed"), 0.5, 1e-3);
  EXPECT_EQ(slips.sensor("x"), 2000);
  EXPECT_NEAR(slips.truth("true_heading"), 0.0, 1e-9);
  ASSERT_TRUE(slips->clear_fault("frozen_pose"));
  EXPECT_GT(slips.sensor("x"), 2100);

  Rig drifts(hall());
  drifts.fault("drift", 2);
  drifts.run(6s);
  EXPECT_NEAR(drifts.sensor("x"), 2012, 1);

  Rig weak(hall());
  weak.fault("weak", 0.1);
  weak.drive(2000);
  weak.run(2s);
  EXPECT_NEAR(weak.truth("true_speed"), 0.2, 0.01);

  Rig pressed(hall());
  pressed.drive(1000);
  pressed.run(3s);
  pressed.fault("press_estop", 1);
  pressed.run(2s);
  EXPECT_EQ(pressed.sensor("estop_ok"), 0);
  EXPECT_NEAR(pressed.truth("true_speed"), 0.0, 1e-4);
  pressed.fault("press_estop", 0);
  pressed.run(2s);
  EXPECT_GT(pressed.truth("true_speed"), 0.9);
}

TEST(Tugger, WhenTrailersAreLeft_ThenTheyStandInTheWayUntilTheyAreCoupledAgain) {
  Rig rig(hall(3));
  rig.drive(1000);
  rig.run(1s);
  rig.fault("leave_trailers", 1);
  EXPECT_EQ(rig.sensor("trailers"), 1);
  EXPECT_EQ(rig.sensor("hitch_2"), 0);
  EXPECT_EQ(rig.truth("true_state_1"), 1.0);
  EXPECT_EQ(rig.truth("true_state_2"), 2.0);
  const double x_m = rig.truth("true_x_2");
  rig.run(2s);
  EXPECT_EQ(rig.sensor("bumper"), 0);
  EXPECT_EQ(rig.truth("true_x_2"), x_m);
  EXPECT_EQ(rig.refused("couple_trailers", 3), "C0312");  // it moves
  rig.drive(-1000);
  rig.run(6s);
  EXPECT_EQ(rig.sensor("bumper"), 1);  // against the one that it left
  EXPECT_NEAR(rig.truth("true_x_1"), x_m + 0.9, 0.011);
  EXPECT_EQ(rig.refused("couple_trailers", 0), "C0312");  // fewer than now
  rig.fault("couple_trailers", 3);
  EXPECT_EQ(rig.sensor("trailers"), 3);
  EXPECT_NEAR(rig.truth("true_x_3"), rig.truth("true_x") - 3.0, 1e-9);
  rig.set("enable", 0);
  rig.run(20ms);
  rig.drive(1000);
  rig.run(2s);
  EXPECT_EQ(rig.sensor("bumper"), 0);
  EXPECT_EQ(rig.truth("contacts"), 1.0);
}

TEST(Tugger, WhenATrailerIsLeftWhereItOverlapsItsNeighbour_ThenTheTrainCanDriveOff) {
  TuggerParameters parameters = hall(2);
  parameters.links.length_m = 0.98;
  parameters.obstacles.clear();
  Rig rig(parameters);
  rig.drive(800, 2400);
  rig.run(6s);
  const std::vector<PlacedBox> boxes(rig->train().boxes().begin(), rig->train().boxes().end());
  ASSERT_TRUE(meets(boxes[0], boxes[1]));  // the hitch is bent so far
  ASSERT_EQ(rig.sensor("bumper"), 0);
  rig.fault("leave_trailers", 0);
  rig.drive(800);
  rig.run(3s);
  EXPECT_EQ(rig.sensor("bumper"), 0);
  EXPECT_EQ(rig.truth("contacts"), 0.0);
}

TEST(Tugger, WhenThereIsNoRoomBehindIt_ThenTrailersAreRefused) {
  TuggerParameters parameters = hall(1);
  parameters.most_trailers = 4;
  parameters.start.position.x = 3.0;
  Rig rig(parameters);
  EXPECT_EQ(rig.refused("couple_trailers", 3), "C0312");
  EXPECT_EQ(rig.sensor("trailers"), 1);
  rig.fault("couple_trailers", 2);
  EXPECT_EQ(rig.sensor("trailers"), 2);
  EXPECT_EQ(rig.truth("true_state_3"), 0.0);
}

TEST(Tugger, WhenAFaultIsWrong_ThenTheMessageSaysWhatThereIs) {
  Rig rig(hall());
  EXPECT_EQ(rig.refused("leak_a1", 1.0), "C0311");
  EXPECT_EQ(rig.refused("slip", 2.0), "C0312");
  EXPECT_EQ(rig.refused("leave_trailers", 1.5), "C0312");
  EXPECT_EQ(rig.refused("couple_trailers", 4.0), "C0312");
  EXPECT_EQ(rig->clear_fault("block_3").error().front().code, "C0311");
}

TEST(Tugger, WhenItIsDescribed_ThenEveryNameIsAPortOrATruth) {
  Rig rig(hall());
  const core::PlantDescription& description = rig->description();
  EXPECT_EQ(description.regions.size(), 1u + 1u + 2u + 2u);
  ASSERT_EQ(description.links.size(), 4u);
  for (const core::LinkDescription& link : description.links) {
    for (const std::string& name : {link.x_truth, link.y_truth, link.heading_truth, link.state_truth})
      EXPECT_TRUE(name.empty() || core::find_truth(*rig.operator->(), name)) << name;
  }
  for (const core::RegionDescription& region : description.regions) {
    const bool is_port = core::find_sensor(*rig.operator->(), region.live).has_value();
    const bool is_truth = core::find_truth(*rig.operator->(), region.live).has_value();
    EXPECT_EQ(is_port, region.kind == core::RegionKind::Place) << region.name;
    EXPECT_EQ(is_truth, region.kind == core::RegionKind::Blockage) << region.name;
  }
}

// Drives about, into walls and what it left; each scan of 10 ms is advanced in `slices` parts.
std::uint64_t trace(std::uint64_t seed, int slices) {
  TuggerParameters parameters = hall(4);
  parameters.noise = {};
  parameters.slip = {};
  parameters.seed = seed;
  Rig rig(parameters);
  std::uint64_t hash = 0;
  for (int scan = 0; scan < 1500; ++scan) {
    rig.drive(1800 - 500 * ((scan / 200) % 5), 100 * ((scan / 50) % 60) - 3000);
    rig.set("enable", scan % 300 != 0);
    if (scan == 600) rig.fault("leave_trailers", 2);
    if (scan == 900) rig.fault("block_1", 1);
    for (int k = 1; k <= slices; ++k) rig->advance_to(scan * 10ms + 10ms * k / slices);
    for (std::uint32_t s = 0; s < rig->sensors().size(); ++s)
      hash = hash * 31 + static_cast<std::uint64_t>(rig->sensor(core::SensorId(s)));
  }
  return hash ^ rig->state_hash();
}

TEST(Tugger, WhenSeedAndInputsAreEqual_ThenEveryBitIs) {
  EXPECT_EQ(trace(3, 1), trace(3, 1));
  EXPECT_EQ(trace(3, 1), trace(3, 3));
  EXPECT_NE(trace(3, 1), trace(4, 1));
}

TEST(Tugger, WhenItIsKept_ThenAnotherGoesOnFromThere) {
  TuggerParameters parameters = hall(3);
  parameters.most_trailers = 5;
  Rig before(parameters);
  before.drive(1000, 1500);
  before.run(2s);
  before.fault("leave_trailers", 1);
  before.run(2s);
  std::vector<double> kept(before->kept_size());
  before->keep(kept);
  Rig after(parameters);
  ASSERT_TRUE(after->resume(kept));
  std::vector<double> again(after->kept_size());
  after->keep(again);
  EXPECT_EQ(again, kept);
  EXPECT_EQ(after.sensor("trailers"), 1);
  EXPECT_EQ(after.truth("true_state_3"), 2.0);
  EXPECT_EQ(after.truth("true_heading_1"), before.truth("true_heading_1"));
  EXPECT_EQ(after.truth("true_speed"), 0.0);
  after.drive(1000);
  after.run(1s);
  EXPECT_GT(after.truth("true_speed"), 0.8);
  for (std::size_t wrong = 0; wrong < kept.size(); ++wrong) {
    std::vector<double> broken = kept;
    broken[wrong] = std::nan("");
    EXPECT_FALSE(Rig(parameters)->resume(broken)) << wrong;
  }
  std::vector<double> broken = kept;
  broken[3 + 4 * 4] = 1.0;  // the last one is coupled, the second is not
  EXPECT_FALSE(Rig(parameters)->resume(broken));
}

TEST(Tugger, WhenRunning_ThenNothingIsAllocated) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns the allocator";
  Rig rig(hall());
  rig.drive(1200, 1000);
  rig.run(100ms);
  const support::GuardCounts before = support::guard_counts();
  for (int scan = 0; scan < 1000; ++scan) {
    rig->advance(10ms);
    for (std::uint32_t s = 0; s < rig->sensors().size(); ++s) (void)rig->sensor(core::SensorId(s));
  }
  EXPECT_EQ(support::guard_counts(), before);
}

}  // namespace
}  // namespace stepwright::assemblies

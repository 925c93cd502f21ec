// Image and document of a vehicle as the messages that say the same.

#include "supervisor/fleet/vda5050/link/vehicle_reading.h"

#include <gtest/gtest.h>

#include <cmath>

#include "supervisor/fleet/vda5050/check_message.h"
#include "supervisor/fleet/vda5050/write_message.h"
#include "tests/unit/supervisor/fleet/vda5050/link/made_document.h"

namespace stepwright::vda5050_link {
namespace {

using namespace fleet::vda5050;

constexpr std::size_t kTruck = 1;

class VehicleReadingTest : public ::testing::Test {
 protected:
  VehicleReadingTest() {
    const auto document = read_plan_document(document_of(crossing_plan()).dump(), "document",
                                             [](const std::string&) { return VehicleData{}; });
    fleet_ = *document->fleet;
    orders_.emplace(*FleetOrders::create(fleet_.plan, {.releases = Releases::ByController}));
    first_ = orders_->begin({}, {{"v1", {}}, {"truck_2", {}}});
  }

  const fleet::VehicleMission& mission() const { return fleet_.plan.missions[kTruck]; }

  // The image of the truck when it is so far, exactly on its path.
  VehicleImage at(double arc_m) const {
    VehicleImage seen;
    const geometry::PathPose* pose = &mission().path.front();
    for (const auto& each : mission().path) {
      if (each.arc_m <= arc_m + 1e-6) pose = &each;
    }
    seen.x_m = pose->pose.x_m;
    seen.y_m = pose->pose.y_m;
    seen.heading_rad = pose->pose.heading_rad;
    seen.arc_m = arc_m;
    seen.wheelbase_m = 1.9;
    seen.known = seen.estop_ok = true;
    return seen;
  }

  VehicleReading reading(const VehicleImage& seen) const {
    return reading_of({.image = seen,
                       .vehicle = fleet_.vehicles[kTruck],
                       .mission = mission(),
                       .orders = *orders_,
                       .map_id = "hall",
                       .controller = controller_});
  }

  State state(const VehicleImage& seen) const {
    VehicleSide side({"uagv", "Stepwright", "truck_2"});
    side.take(first_[kTruck], Sender::Control, {});
    side.show(reading(seen));
    State said = side.state({});
    EXPECT_EQ(result::to_string(check_message(Topic::State, to_json(said), "state")), "");
    return said;
  }

  FleetDocument fleet_;
  std::optional<FleetOrders> orders_;
  std::vector<Order> first_;
  std::string controller_;
};

TEST_F(VehicleReadingTest, Place_WhenItDrivesACurveInReverse_ThenInTheVehiclesFrame) {
  VehicleImage seen = at(3.0);
  seen.speed_mps = -0.8;
  seen.lock_rad = 0.2;
  const State said = state(seen);
  EXPECT_NEAR(said.position->y_m, 13.0, 1e-3);
  EXPECT_EQ(said.position->map_id, "hall");
  EXPECT_DOUBLE_EQ(said.velocity->vx_mps, -0.8);
  EXPECT_NEAR(said.velocity->omega_radps, -0.8 * std::tan(0.2) / 1.9, 1e-12);
  seen.known = false;
  EXPECT_FALSE(state(seen).position);
}

TEST_F(VehicleReadingTest, Nodes_WhenTheWayGrows_ThenTheyArePassedOneAfterTheOtherUpToTheBase) {
  std::size_t before = 0;
  for (double arc_m = 0.0; arc_m < mission().path.back().arc_m; arc_m += 0.1) {
    const std::size_t passed = reading(at(arc_m)).passed;
    ASSERT_GE(passed, before);
    ASSERT_LE(passed, before + 2) << arc_m;
    before = passed;
  }
  VehicleImage done = at(mission().path.back().arc_m - 0.2);
  done.done = true;
  EXPECT_EQ(reading(done).passed, first_[kTruck].nodes.size());
  // v1 has left nothing yet: the truck's base is short, and its state does not go beyond it.
  EXPECT_EQ(state(done).last_node, first_[kTruck].nodes[*decision_point(first_[kTruck])].id);
}

TEST_F(VehicleReadingTest,
       Actions_WhenTheSupervisorSaysTheStopIsDoneOrTheVehicleHasGoneOn_ThenTheyAreFinished) {
  const auto pick = [&](const VehicleImage& seen) { return state(seen).actions.front().status; };
  EXPECT_EQ(pick(at(4.0)), ActionStatus::Waiting);
  EXPECT_EQ(pick(at(7.95)), ActionStatus::Running);
  fleet_.vehicles[kTruck].stops_done = 1;
  EXPECT_EQ(pick(at(7.95)), ActionStatus::Finished);
  fleet_.vehicles[kTruck].stops_done = 0;
  EXPECT_EQ(pick(at(8.4)), ActionStatus::Finished);
  VehicleImage empty = at(8.0);
  empty.error_id = 29;
  EXPECT_EQ(pick(empty), ActionStatus::Failed);
}

TEST_F(VehicleReadingTest, Errors_WhenTheControllerStopsTheVehicle_ThenFatalWithNumberAndPlace) {
  for (int error = 1; error < 40; ++error) {
    VehicleImage seen = at(5.0);
    seen.error_id = error;
    seen.error_x_m = 30.5;
    const State said = state(seen);
    ASSERT_EQ(said.errors.size(), 1u) << error;
    EXPECT_EQ(said.errors[0].level, ErrorLevel::Fatal);
    EXPECT_EQ(said.errors[0].references[0].second, std::to_string(error));
    EXPECT_EQ(said.emergency_stop, error == 24 ? EmergencyStop::Manual : EmergencyStop::None);
  }
}

TEST_F(VehicleReadingTest, Safety_WhenStopAndBumperArePressed_ThenTheyAreSaid) {
  VehicleImage seen = at(5.0);
  seen.estop_ok = false;
  seen.bumper = true;
  EXPECT_EQ(state(seen).emergency_stop, EmergencyStop::Manual);
  EXPECT_TRUE(state(seen).field_violation);
}

TEST_F(VehicleReadingTest, Errors_WhenTheVehicleIsLostOrTheProgramStopped_ThenTheirReasons) {
  fleet_.vehicles[kTruck].state = "lost";
  fleet_.vehicles[kTruck].reason = "its navigation says nothing";
  controller_ = "the controller has a fault";
  const State said = state(at(5.0));
  ASSERT_EQ(said.errors.size(), 2u);
  EXPECT_EQ(said.errors[0].type, "controllerStopped");
  EXPECT_EQ(said.errors[1].type, "vehicleLost");
  EXPECT_EQ(said.errors[1].description, "its navigation says nothing");
}

TEST_F(VehicleReadingTest, Image_WhenItIsOfTheMissionBefore_ThenItIsNotPlausible) {
  EXPECT_TRUE(plausible(at(0.0), mission()));
  EXPECT_TRUE(plausible(at(20.0), mission()));
  VehicleImage stale = at(0.0);
  stale.arc_m = 25.0;  // of another path
  EXPECT_FALSE(plausible(stale, mission()));
  stale = at(0.0);
  stale.left = 3;
  EXPECT_FALSE(plausible(stale, mission()));
  stale = at(mission().path.back().arc_m);
  stale.arc_m += 5.0;
  EXPECT_FALSE(plausible(stale, mission()));
  stale.error_id = 21;  // it is off its path, and known to be
  EXPECT_TRUE(plausible(stale, mission()));
}

TEST_F(VehicleReadingTest, VehicleLocation_WhenTheImageIsOutOfBounds_ThenTheyAreWithin) {
  VehicleImage seen = at(1.0);
  seen.left = -5;
  EXPECT_EQ(location_of(seen, mission()).left, 0u);
  seen.left = 30'000;
  EXPECT_EQ(location_of(seen, mission()).left, mission().grown.visits.size());
}

}  // namespace
}  // namespace stepwright::vda5050_link

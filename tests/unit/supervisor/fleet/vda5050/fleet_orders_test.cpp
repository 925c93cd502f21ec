#include "supervisor/fleet/vda5050/fleet_orders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "supervisor/fleet/vda5050/write_message.h"
#include "tests/unit/supervisor/fleet/vda5050/order_world.h"

namespace stepwright::fleet::vda5050 {
namespace {

using support::MadeMission;
using support::SplitMix64;

// Two aisles that cross at (30, 30); v1 has the shorter way there.
FleetPlan crossing() {
  return support::scheduled(
      {MadeMission("v1", {16, 30, 0}).drive(30.0).mission(), MadeMission("v2", {30, 10, 1.5707963267948966})
                                                                 .drive(8.0)
                                                                 .stop(StopKind::PickUp, "rack", "load7")
                                                                 .drive(26.0)
                                                                 .stop(StopKind::SetDown, "dock", "load7")
                                                                 .mission()});
}

TEST(FleetOrders,
     FirstOrders_WhenAnotherVehicleComesFirst_ThenTheBaseEndsBeforeItsPolygonAndTheHorizonFollows) {
  OrderWorld world(crossing());
  const Order& first = world.sent_first("v1");
  const Order& second = world.sent_first("v2");
  EXPECT_TRUE(first.nodes.back().released);
  const std::size_t end = *decision_point(second);
  ASSERT_LT(end + 1, second.nodes.size());
  // Standing there the vehicle is beside the aisle, with its forks, and one node further on it is not.
  EXPECT_LT(second.nodes[end].position->y_m + VehicleModel{}.front_m, 30.0 - 0.7);
  EXPECT_GT(second.nodes[end].position->y_m, 18.0);
}

TEST(FleetOrders, Base_WhenTheFirstVehicleHasPassed_ThenItGrowsByAnUpdate) {
  OrderWorld world(crossing());
  EXPECT_EQ(world.updates("v2"), 0u);
  while (world.drive("v1")) {
  }
  EXPECT_EQ(world.faults(), "");
  EXPECT_GT(world.updates("v2"), 0u);
  EXPECT_TRUE(world.orders().order("v2")->nodes.back().released);
  EXPECT_TRUE(world.orders().arrived("v1"));
}

TEST(FleetOrders, Actions_WhenTheVehicleStopsToWork_ThenPickAndDropWithTheStation) {
  OrderWorld world(crossing());
  std::vector<Action> actions;
  for (const Node& node : world.sent_first("v2").nodes) {
    actions.insert(actions.end(), node.actions.begin(), node.actions.end());
  }
  ASSERT_EQ(actions.size(), 2u);
  EXPECT_EQ(actions[0].type, "pick");
  EXPECT_EQ(actions[1].type, "drop");
  EXPECT_EQ(actions[0].blocking, Blocking::Hard);
  const std::pair<std::string, ParameterValue> station{"stationName", std::string("rack")};
  EXPECT_EQ(actions[0].parameters.front(), station);
}

TEST(FleetOrders, Parking_WhenAtAChargingLocation_ThenItChargesAndTheNextOrderEndsThat) {
  FleetPlan plan = support::scheduled(
      {MadeMission("v1", {16, 30, 0}).drive(10.0).stop(StopKind::Park, "charger").mission()});
  OrderWorld world(std::move(plan), {.charging_locations = {"charger"}});
  ASSERT_EQ(world.sent_first("v1").nodes.back().actions.size(), 1u);
  EXPECT_EQ(world.sent_first("v1").nodes.back().actions[0].type, "startCharging");
  while (world.drive("v1", true)) {
  }
  const auto orders = world.adopt(support::scheduled({MadeMission("v1", {26, 30, 0}).drive(10.0).mission()}));
  ASSERT_EQ(orders.size(), 1u);
  ASSERT_EQ(orders[0].nodes.front().actions.size(), 1u);
  EXPECT_EQ(orders[0].nodes.front().actions[0].type, "stopCharging");
}

TEST(FleetOrders, Edges_WhenTheVehicleReverses_ThenOrientationIsPiAndTheTrajectoryEndsAtItsNodes) {
  OrderWorld world(support::scheduled(
      {MadeMission("v1", {16, 30, 0}).drive(8.0, 0.1).drive(4.0, 0.0, geometry::Travel::Reverse).mission()}));
  const Order& order = world.sent_first("v1");
  EXPECT_EQ(order.edges.front().orientation_rad, 0.0);
  EXPECT_NEAR(*order.edges.back().orientation_rad, 3.14159265358979, 1e-12);
  for (std::size_t k = 0; k < order.edges.size(); ++k) {
    const Trajectory& curve = *order.edges[k].trajectory;
    EXPECT_EQ(curve.points.front().x_m, order.nodes[k].position->x_m);
    EXPECT_EQ(curve.points.back().y_m, order.nodes[k + 1].position->y_m);
    EXPECT_EQ(order.edges[k].max_speed_mps, 1.5);
  }
}

// Vehicles go on in a random order, messages are lost and repeated, states come late.
TEST(FleetOrders, Fleet_WhenMessagesAreLostAndLate_ThenAllArriveAndNoPolygonHasTwoMasters) {
  std::size_t updates = 0, waits = 0;
  for (std::uint64_t seed = 1; seed <= 14; ++seed) {
    SplitMix64 random(seed);
    const auto vehicles = static_cast<std::uint32_t>(3 + seed % 5);
    OrderWorld world(support::random_plan(vehicles, seed));
    world.lose(random, 0.3);
    int rounds = 0;
    for (; rounds < 4000 && !world.all_arrived(); ++rounds) {
      const std::string name = "v" + std::to_string(1 + random.below(vehicles));
      if (!world.drive(name)) ++waits;
      if (random.below(4) == 0) world.repeat(name);
      ASSERT_EQ(world.faults(), "") << "seed " << seed << ", round " << rounds;
    }
    EXPECT_TRUE(world.all_arrived()) << "seed " << seed;
    updates += world.updates();
  }
  EXPECT_GT(updates, 20u);
  EXPECT_GT(waits, 50u);
}

TEST(FleetOrders, State_WhenItContradictsTheOrder_ThenItIsToldAndNothingMoves) {
  OrderWorld world(crossing());
  world.drive("v2");
  const Order order = *world.orders().order("v2");
  const auto told = [&](State state) {
    const Progress progress = world.orders().take(state, {});
    EXPECT_TRUE(progress.orders.empty());
    return progress.wrong.empty() ? std::string()
                                  : progress.wrong.front().code + " " + progress.wrong.front().message;
  };
  State state = world.vehicle("v2").state({});
  state.last_node = order.nodes.back().id;
  state.last_node_sequence = order.nodes.back().sequence;
  EXPECT_EQ(told(state), "F0907 /lastNodeId: '" + order.nodes.back().id + "' was not released");
  state.last_node = "somewhere";
  EXPECT_EQ(told(state), "F0907 /lastNodeId: 'somewhere' is not where the order leads");
  state.last_node_sequence = 4294967294;
  EXPECT_EQ(told(state), "F0907 /lastNodeId: 'somewhere' is not where the order leads");
  state = world.vehicle("v2").state({});
  state.update_id = 9;
  EXPECT_EQ(told(state), "F0907 /orderUpdateId: 9 was never sent");
  state.header.serial_number = "v9";
  EXPECT_EQ(told(state), "F0907 /serialNumber: no vehicle of the plan is 'Stepwright v9'");
  EXPECT_EQ(*world.orders().order("v2"), order);
}

TEST(FleetOrders, State_WhenTheVehicleComplains_ThenWarned) {
  OrderWorld world(crossing());
  State state = world.vehicle("v1").state({});
  state.errors = {{"laserBlocked", ErrorLevel::Fatal, "dirt", {}}};
  const Progress progress = world.orders().take(state, {});
  ASSERT_EQ(progress.wrong.size(), 1u);
  EXPECT_EQ(progress.wrong[0].code, "F0909");
  EXPECT_EQ(progress.wrong[0].severity, result::Severity::Warning);
}

TEST(FleetOrders, Create_WhenPlanOrNamesCannotBeSent_ThenRefused) {
  FleetPlan plan = crossing();
  plan.missions[1].vehicle = "fork lift";
  plan.schedule.verdict = Verdict::Infeasible;
  const auto made = FleetOrders::create(plan, {.plan_name = "a/b"});
  ASSERT_FALSE(made.has_value());
  ASSERT_EQ(made.error().size(), 3u);
  for (const auto& wrong : made.error()) EXPECT_EQ(wrong.code, "F0906");
}

}  // namespace
}  // namespace stepwright::fleet::vda5050

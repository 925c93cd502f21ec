// Orders that go on with another plan.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/supervisor/fleet/vda5050/order_world.h"

namespace stepwright::fleet::vda5050 {
namespace {

using support::MadeMission;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kNorth = 1.5707963267948966;

MadeMission west_to_east() {
  MadeMission made("v1", {16, 30, 0});
  made.drive(30.0);
  return made;
}

// v2 waits before the aisle that v1 drives along.
FleetPlan crossing() {
  return support::scheduled(
      {west_to_east().mission(), MadeMission("v2", {30, 10, kNorth}).drive(34.0).mission()});
}

// The rest of v1's way as a path that begins where it has come to.
MadeMission rest_of_v1(double from_m) {
  MadeMission made("v1", {16 + from_m, 30, 0});
  made.drive(30.0 - from_m);
  return made;
}

// The ids of the nodes of the base.
std::vector<std::string> base_of(const Order& order) {
  std::vector<std::string> ids;
  for (const Node& node : order.nodes) {
    if (node.released) ids.push_back(node.id);
  }
  return ids;
}

TEST(Replan, Horizon_WhenItIsOtherAndTheBaseStays_ThenAnUpdateReplacesIt) {
  OrderWorld world(crossing());
  const Order before = *world.orders().order("v2");
  const auto base = base_of(before);
  // v2 turns off behind its base instead of crossing.
  MadeMission turned("v2", {30, 10, kNorth});
  turned.drive(16.0).drive(8.0, 0.2).drive(4.0);
  const FleetPlan next = support::scheduled({west_to_east().mission(), turned.mission()});
  ASSERT_EQ(next.schedule.verdict, Verdict::Scheduled);
  ASSERT_THAT(world.orders().affected(next), IsEmpty());
  const auto orders = world.adopt(next);
  EXPECT_EQ(world.faults(), "");  // each message is sound, each update stitches
  ASSERT_EQ(orders.size(), 2u);
  const Order& after = *world.orders().order("v2");
  EXPECT_EQ(after.order_id, before.order_id);
  EXPECT_GT(after.update_id, before.update_id);
  const auto grown = base_of(after);
  ASSERT_GE(grown.size(), base.size());
  EXPECT_TRUE(std::equal(base.begin(), base.end(), grown.begin()));
  EXPECT_NEAR(after.nodes.back().position->x_m, turned.path().back().pose.x_m, 1e-9);
  for (int k = 0; k < 200 && !world.all_arrived(); ++k) {
    world.drive("v1");
    world.drive("v2");
  }
  EXPECT_TRUE(world.all_arrived());
  EXPECT_EQ(world.faults(), "");
}

TEST(Replan, Horizon_WhenTheVehicleIsUnderWayAndThePathBeginsOnItsBase_ThenItGoesOn) {
  OrderWorld world(crossing());
  world.drive("v1");
  world.drive("v1");
  const FleetPlan next = support::scheduled(
      {rest_of_v1(4.0).mission(), MadeMission("v2", {30, 10, kNorth}).drive(34.0).mission()});
  ASSERT_THAT(world.orders().affected(next), IsEmpty());
  world.adopt(next);
  for (int k = 0; k < 200 && !world.all_arrived(); ++k) {
    world.drive("v1");
    world.drive("v2");
  }
  EXPECT_TRUE(world.all_arrived());
  EXPECT_EQ(world.faults(), "");
}

TEST(Replan, Base_WhenTheNewPathLeavesIt_ThenTheVehicleIsAffectedAndNothingChangesWithoutACancellation) {
  OrderWorld world(crossing());
  world.drive("v1");
  MadeMission turned("v1", {16, 30, 0});
  turned.drive(6.0).drive(7.0, -0.2);
  const FleetPlan next =
      support::scheduled({turned.mission(), MadeMission("v2", {30, 10, kNorth}).drive(34.0).mission()});
  ASSERT_EQ(next.schedule.verdict, Verdict::Scheduled);
  EXPECT_THAT(world.orders().affected(next), ElementsAre("v1"));
  const Order before = *world.orders().order("v1");
  const auto refused = world.orders().adopt(next, {});
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().front().code, "F0908");
  EXPECT_THAT(refused.error().front().message, HasSubstr("the base of 'v1' does not fit"));
  EXPECT_EQ(*world.orders().order("v1"), before);

  world.cancel("v1");
  EXPECT_EQ(world.orders().hold("v1"), Hold::Idle);
  const auto orders = world.adopt(next);
  EXPECT_EQ(world.faults(), "");
  ASSERT_EQ(orders.size(), 2u);
  EXPECT_EQ(orders[0].header.serial_number, "v1");
  EXPECT_EQ(orders[0].update_id, 0u);
  EXPECT_NE(orders[0].order_id, before.order_id);
  for (int k = 0; k < 200 && !world.all_arrived(); ++k) {
    world.drive("v1");
    world.drive("v2");
  }
  EXPECT_TRUE(world.all_arrived());
  EXPECT_EQ(world.faults(), "");
}

TEST(Replan, Base_WhenAnotherVehicleIsToComeFirstWhereItLeads_ThenTheVehicleIsAffected) {
  OrderWorld world(crossing());
  FleetPlan next = crossing();
  // The other order: v1 only after v2, although v1's base goes through.
  std::vector<Precedence> turned;
  for (const Precedence& order : next.schedule.precedences) {
    turned.push_back(
        {{order.second.vehicle, order.second.polygon}, {order.first.vehicle, order.first.polygon}});
  }
  next.schedule.precedences = turned;
  EXPECT_THAT(world.orders().affected(next), ElementsAre("v1"));
}

TEST(Replan, Work_WhenThatOfTheBaseIsOther_ThenTheVehicleIsAffected) {
  const auto plan = [](const char* goal) {
    return support::scheduled({MadeMission("v1", {16, 30, 0})
                                   .drive(10.0)
                                   .stop(StopKind::PickUp, "rack", goal)
                                   .drive(10.0)
                                   .mission()});
  };
  OrderWorld world(plan("load1"));
  EXPECT_THAT(world.orders().affected(plan("load2")), ElementsAre("v1"));
  EXPECT_THAT(world.orders().affected(plan("load1")), IsEmpty());
}

TEST(Replan, Cancellation_WhenItIsNotConfirmed_ThenNoBaseGrowsAndNoPlanIsTaken) {
  OrderWorld world(crossing());
  ASSERT_TRUE(world.orders().cancel("v2", {}).has_value());
  EXPECT_EQ(world.orders().hold("v2"), Hold::Cancelling);
  while (world.drive("v1")) {
  }
  EXPECT_EQ(world.updates("v2"), 0u);
  EXPECT_THAT(world.orders().unacknowledged("v2", {}), IsEmpty());
  const auto refused = world.orders().adopt(crossing(), {});
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(to_string(refused.error()), HasSubstr("'v2' has not confirmed yet"));
}

TEST(Replan, NewOrder_WhenThePathDoesNotBeginWhereTheVehicleStands_ThenRefused) {
  OrderWorld world(support::scheduled({west_to_east().mission()}));
  while (world.drive("v1")) {
  }
  ASSERT_TRUE(world.orders().arrived("v1"));
  const auto refused = world.orders().adopt(support::scheduled({west_to_east().mission()}), {});
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().front().message, HasSubstr("does not begin where the vehicle stands"));
  const auto taken =
      world.orders().adopt(support::scheduled({MadeMission("v1", {46, 30, 0}).drive(5.0).mission()}), {});
  ASSERT_TRUE(taken.has_value());
  EXPECT_EQ(taken->front().update_id, 0u);
}

TEST(Replan, Vehicle_WhenItHasAnOrderAndIsMissingInThePlan_ThenRefused) {
  OrderWorld world(crossing());
  const auto refused = world.orders().adopt(support::scheduled({west_to_east().mission()}), {});
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(to_string(refused.error()), HasSubstr("'v2' has an order and is not in the plan"));
}

}  // namespace
}  // namespace stepwright::fleet::vda5050

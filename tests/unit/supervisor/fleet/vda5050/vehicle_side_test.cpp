#include "supervisor/fleet/vda5050/vehicle_side.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "supervisor/fleet/vda5050/check_message.h"
#include "supervisor/fleet/vda5050/fleet_orders.h"
#include "supervisor/fleet/vda5050/write_message.h"
#include "tests/support/vda5050/made_missions.h"

namespace stepwright::fleet::vda5050 {
namespace {

using std::chrono::seconds;
using support::MadeMission;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr Timestamp kNow{};

// Where a load is taken after 8 m and left at the end.
Order errand() {
  const FleetPlan plan = support::scheduled({MadeMission("v1", {10, 30, 0})
                                                 .drive(8.0)
                                                 .stop(StopKind::PickUp, "rack", "load7")
                                                 .drive(20.0)
                                                 .stop(StopKind::SetDown, "dock", "load7")
                                                 .mission()});
  return FleetOrders::create(plan, {.releases = Releases::ByController})->begin(kNow).front();
}

VehicleSide side_with(const Order& order) {
  VehicleSide side({"uagv", "Stepwright", "v1"});
  side.take(order, Sender::Control, kNow);
  return side;
}

State judged(VehicleSide& side, Timestamp now = kNow) {
  State state = side.state(now);
  EXPECT_THAT(check_message(Topic::State, to_json(state), "state"), IsEmpty());
  return state;
}

InstantActions asked(const std::string& type, const std::string& id = "a1") {
  return {.header = {.manufacturer = "Stepwright", .serial_number = "v1"},
          .actions = {{.type = type, .id = id, .blocking = Blocking::None, .parameters = {}}}};
}

std::vector<ActionStatus> statuses(const State& state) {
  std::vector<ActionStatus> all;
  for (const ActionState& action : state.actions) all.push_back(action.status);
  return all;
}

std::size_t node_with_pick(const Order& order) {
  std::size_t k = 0;
  while (order.nodes[k].actions.empty()) ++k;
  return k;
}

TEST(VehicleSide, State_WhenNodesArePassed_ThenTheyLeaveTheListsInOrder) {
  const Order order = errand();
  VehicleSide side = side_with(order);
  EXPECT_EQ(judged(side).last_node, "");
  EXPECT_THAT(judged(side).nodes, SizeIs(order.nodes.size()));
  for (std::size_t passed = 1; passed <= order.nodes.size(); ++passed) {
    side.show({.order_id = order.order_id, .passed = passed});
    const State state = judged(side);
    EXPECT_EQ(state.last_node, order.nodes[passed - 1].id);
    EXPECT_THAT(state.nodes, SizeIs(order.nodes.size() - passed));
    EXPECT_THAT(state.edges, SizeIs(order.edges.size() - (passed - 1)));
  }
  side.show({.order_id = "another one", .passed = 1});
  EXPECT_THAT(judged(side).nodes, IsEmpty());
}

TEST(VehicleSide, State_WhenTheVehicleIsFartherThanItsBase_ThenItSaysTheEndOfItsBaseAndAsksForMore) {
  Order order = errand();
  for (std::size_t k = 2; k < order.nodes.size(); ++k) order.nodes[k].released = false;
  for (std::size_t k = 1; k < order.edges.size(); ++k) order.edges[k].released = false;
  VehicleSide side = side_with(order);
  side.show({.order_id = order.order_id, .passed = order.nodes.size()});
  const State state = judged(side);
  EXPECT_EQ(state.last_node, order.nodes[1].id);
  EXPECT_TRUE(state.new_base_request);
}

TEST(VehicleSide, Actions_WhenTheVehicleWorks_ThenTheyWaitRunAndFinish) {
  const Order order = errand();
  const std::size_t pick = node_with_pick(order);
  VehicleSide side = side_with(order);
  side.show({.order_id = order.order_id, .passed = pick});
  EXPECT_THAT(statuses(judged(side)), ElementsAre(ActionStatus::Waiting, ActionStatus::Waiting));
  side.show({.order_id = order.order_id, .passed = pick + 1, .unfinished = 1});
  EXPECT_THAT(statuses(judged(side)), ElementsAre(ActionStatus::Running, ActionStatus::Waiting));
  side.show({.order_id = order.order_id, .passed = pick + 1, .unfinished = 1, .action_failed = true});
  EXPECT_THAT(statuses(judged(side)), ElementsAre(ActionStatus::Failed, ActionStatus::Waiting));
  side.show({.order_id = order.order_id, .passed = pick + 1});
  EXPECT_THAT(statuses(judged(side)), ElementsAre(ActionStatus::Finished, ActionStatus::Waiting));
  side.show({.order_id = order.order_id, .passed = order.nodes.size(), .unfinished = 9});
  EXPECT_THAT(statuses(judged(side)), ElementsAre(ActionStatus::Running, ActionStatus::Waiting));
}

TEST(VehicleSide, Requests_WhenTheCellCannotDoThem_ThenTheyFailWithAnErrorForAWhile) {
  VehicleSide side = side_with(errand());
  for (const char* type : {"startPause", "stopPause", "cancelOrder", "initPosition"}) {
    EXPECT_TRUE(side.take(asked(type, type), "own.cancel", kNow).state);
  }
  const State state = judged(side);
  EXPECT_THAT(state.errors, SizeIs(4));
  for (const VehicleError& error : state.errors) {
    EXPECT_EQ(error.type, "instantActionError");
    EXPECT_EQ(error.level, ErrorLevel::Warning);
  }
  for (std::size_t k = 2; k < state.actions.size(); ++k) {
    EXPECT_EQ(state.actions[k].status, ActionStatus::Failed);
    EXPECT_NE(state.actions[k].result, "");
  }
  EXPECT_TRUE(side.order());  // nobody has cancelled it
  EXPECT_THAT(judged(side, kNow + VehicleSide::kRefusalStays + seconds(1)).errors, IsEmpty());
}

TEST(VehicleSide, Requests_WhenForStateAndFactsheet_ThenBothAreWished) {
  VehicleSide side = side_with(errand());
  EXPECT_FALSE(side.take(asked("stateRequest", "s"), {}, kNow).factsheet);
  EXPECT_TRUE(side.take(asked("factsheetRequest", "f"), {}, kNow).factsheet);
  EXPECT_FALSE(side.take(asked("factsheetRequest", "f"), {}, kNow).factsheet);  // it came twice
  EXPECT_THAT(judged(side).errors, IsEmpty());
}

TEST(VehicleSide, CancelOrder_WhenItIsMasterControls_ThenTheOrderIsDroppedAndItsIdKept) {
  const Order order = errand();
  VehicleSide side = side_with(order);
  side.take(asked("cancelOrder", "own.cancel"), "own.cancel", kNow);
  const State state = judged(side);
  EXPECT_EQ(state.order_id, order.order_id);
  EXPECT_THAT(state.nodes, IsEmpty());
  EXPECT_THAT(statuses(state), ElementsAre(ActionStatus::Finished));
  side.take(asked("cancelOrder", "once more"), {}, kNow);
  EXPECT_EQ(judged(side).errors.back().type, "noOrderToCancel");
}

TEST(VehicleSide, Orders_WhenOfAStrangerOrBroken_ThenTheVehicleKeepsItsOwnAndSaysSo) {
  const Order order = errand();
  VehicleSide side = side_with(order);
  Order other = order;
  other.order_id = "theirs";
  side.take(other, Sender::Stranger, kNow);
  side.refuse(Topic::Order, {{.code = "F0901", .where = {}, .message = "no JSON", .hint = {}}}, kNow);
  const State state = judged(side);
  EXPECT_EQ(state.order_id, order.order_id);
  ASSERT_THAT(state.errors, SizeIs(2));
  EXPECT_EQ(state.errors[0].type, "orderError");
  EXPECT_EQ(state.errors[1].type, "validationError");
}

TEST(VehicleSide, Updates_WhenOneIsLost_ThenTheNextIsTakenOnlyBehindIt) {
  Order order = errand();
  for (std::size_t k = 2; k < order.nodes.size(); ++k) order.nodes[k].released = false;
  for (std::size_t k = 1; k < order.edges.size(); ++k) order.edges[k].released = false;
  const auto update = [&](std::uint32_t id, std::size_t from, std::size_t to) {
    Order next = order;
    next.update_id = id;
    next.nodes.erase(next.nodes.begin(), next.nodes.begin() + static_cast<std::ptrdiff_t>(from));
    next.edges.erase(next.edges.begin(), next.edges.begin() + static_cast<std::ptrdiff_t>(from));
    for (std::size_t k = 0; k <= to - from; ++k) next.nodes[k].released = true;
    for (std::size_t k = 0; k < to - from; ++k) next.edges[k].released = true;
    return next;
  };
  VehicleSide side = side_with(order);
  side.take(update(2, 2, 3), Sender::Control, kNow);
  EXPECT_EQ(judged(side).update_id, 0u);
  side.take(update(1, 1, 2), Sender::Control, kNow);
  side.take(update(2, 2, 3), Sender::Control, kNow);
  side.take(update(1, 1, 2), Sender::Control, kNow);  // late, and known
  EXPECT_EQ(judged(side).update_id, 2u);
  EXPECT_EQ(*decision_point(*side.order()), 3u);
}

TEST(VehicleSide, News_WhenOnlyThePlaceChanges_ThenThereAreNone) {
  VehicleSide side = side_with(errand());
  VehicleReading reading{.position = AgvPosition{1.0, 2.0, 0.0, "floor", true}, .driving = true};
  side.show(reading);
  EXPECT_TRUE(side.has_news(kNow));
  side.state(kNow);
  reading.position->x_m = 1.1;
  reading.velocity.vx_mps = 1.0;
  side.show(reading);
  EXPECT_FALSE(side.has_news(kNow));
  EXPECT_EQ(side.visualization(kNow).position->x_m, 1.1);
  reading.emergency_stop = EmergencyStop::Manual;
  side.show(reading);
  EXPECT_TRUE(side.has_news(kNow));
}

TEST(VehicleSide, Refusals_WhenThousandsCome_ThenTheStateStaysBounded) {
  VehicleSide side = side_with(errand());
  for (int k = 0; k < 3000; ++k) {
    side.take(asked("do " + std::to_string(k), "id " + std::to_string(k)), {}, kNow);
  }
  const State state = judged(side);
  EXPECT_THAT(state.errors, SizeIs(VehicleSide::kMostRefusals));
  EXPECT_THAT(state.actions, SizeIs(2 + VehicleSide::kMostInstantActions));
}

}  // namespace
}  // namespace stepwright::fleet::vda5050

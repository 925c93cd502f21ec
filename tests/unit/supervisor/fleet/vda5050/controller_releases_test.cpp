// Orders of a fleet whose controller counts itself what has been left (Releases::ByController).

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/vda5050/check_message.h"
#include "supervisor/fleet/vda5050/fleet_orders.h"
#include "supervisor/fleet/vda5050/read_message.h"
#include "supervisor/fleet/vda5050/route.h"
#include "supervisor/fleet/vda5050/stitching.h"
#include "supervisor/fleet/vda5050/write_message.h"
#include "tests/support/fleet/split_mix.h"
#include "tests/support/vda5050/made_missions.h"
#include "tests/support/vda5050/standard_vehicle.h"

namespace stepwright::fleet::vda5050 {
namespace {

using support::MadeMission;
using support::SplitMix64;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kNorth = 1.5707963267948966;
const OrderOptions kByController{.plan_name = "live", .releases = Releases::ByController};

MadeMission eastwards() {
  MadeMission made("v1", {16, 30, 0});
  made.drive(30.0);
  return made;
}

// v2 waits before the aisle that v1 drives along.
FleetPlan crossing() {
  return support::scheduled(
      {eastwards().mission(), MadeMission("v2", {30, 10, kNorth}).drive(34.0).mission()});
}

std::size_t polygons_of(const VehicleMission& mission) {
  return mission.grown.visits.size();
}

// What a controller lets in: everything that each precedence on polygon `k` of `v` asks for is left.
bool may_enter(const FleetPlan& plan, const Places& places, std::uint32_t v, std::uint32_t k) {
  return std::ranges::all_of(plan.schedule.precedences, [&](const Precedence& p) {
    return p.second != PolygonRef{v, k} ||
           places.at(plan.missions[p.first.vehicle].vehicle).left > p.first.polygon;
  });
}

// The first polygon that the base leads into and that is not to be entered yet; nothing if all is well.
std::optional<std::uint32_t> base_beyond(const FleetPlan& plan, const Places& places, const Order& order,
                                         const Route& route, std::uint32_t v) {
  const std::size_t end = *decision_point(order);
  for (std::uint32_t k = 0; end > 0 && k <= route.nodes[end - 1].polygon; ++k) {
    if (!may_enter(plan, places, v, k)) return k;
  }
  return std::nullopt;
}

TEST(ControllerReleases, Base_WhenTheFirstVehicleIsLate_ThenItStaysShortWhateverStatesSay) {
  const FleetPlan plan = crossing();
  auto orders = FleetOrders::create(plan, kByController);
  Places places{{"v1", {}}, {"v2", {}}};
  const auto first = orders->begin({}, places);
  ASSERT_EQ(first.size(), 2u);
  const std::size_t before = *decision_point(*orders->order("v2"));
  ASSERT_LT(before + 1, orders->order("v2")->nodes.size());
  // v1 says that it has passed everything; the controller has not seen it leave anything.
  support::StandardVehicle vehicle("Stepwright", "v1");
  vehicle.take_order(to_json(first[0]));
  while (vehicle.drive()) {
    EXPECT_THAT(orders->take(vehicle.state({}), {}).orders, IsEmpty());
  }
  EXPECT_THAT(orders->place(places, {}).orders, IsEmpty());
  EXPECT_EQ(*decision_point(*orders->order("v2")), before);
  places["v1"].left = static_cast<std::uint32_t>(polygons_of(plan.missions[0])) - 1;
  const Progress progress = orders->place(places, {});
  ASSERT_EQ(progress.orders.size(), 1u);
  EXPECT_THAT(progress.wrong, IsEmpty());
  EXPECT_GT(*decision_point(*orders->order("v2")), before);
}

TEST(ControllerReleases, Bases_WhenPolygonsAreLeftInAnyOrder_ThenNoneLeadsBeyondAnUnmetPrecedence) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SplitMix64 random(seed);
    const FleetPlan plan = support::random_plan(4, seed);
    auto orders = FleetOrders::create(plan, kByController);
    ASSERT_TRUE(orders);
    Places places;
    std::map<std::string, Order> held;
    std::vector<Route> routes;
    for (const VehicleMission& mission : plan.missions) routes.push_back(route_of(mission, {}));
    for (const VehicleMission& mission : plan.missions) places[mission.vehicle] = {};
    for (const Order& order : orders->begin({}, places)) held[order.header.serial_number] = order;
    for (int step = 0; step < 500; ++step) {
      const auto v = static_cast<std::uint32_t>(random.below(plan.missions.size()));
      VehicleLocation& at = places[plan.missions[v].vehicle];
      // To leave a polygon it has to be in the next one, by the controller's rule.
      const std::uint32_t next = at.left + 1;
      bool may = next < polygons_of(plan.missions[v]);
      for (std::uint32_t k = 0; may && k <= next; ++k) may = may_enter(plan, places, v, k);
      if (may) ++at.left;
      const Progress progress = orders->place(places, {});
      ASSERT_THAT(progress.wrong, IsEmpty()) << seed;
      for (const Order& order : progress.orders) {
        Order& before = held.at(order.header.serial_number);
        ASSERT_THAT(check_update(before, order, "update"), IsEmpty()) << seed;
        ASSERT_THAT(check_message(Topic::Order, to_json(order), "update"), IsEmpty()) << seed;
        before = stitched(before, order);
      }
      for (std::uint32_t other = 0; other < plan.missions.size(); ++other) {
        const Order& order = *orders->order(plan.missions[other].vehicle);
        ASSERT_FALSE(base_beyond(plan, places, order, routes[other], other)) << "seed " << seed;
      }
    }
    for (const VehicleMission& mission : plan.missions) {
      EXPECT_EQ(places[mission.vehicle].left + 1, polygons_of(mission)) << seed;
      EXPECT_TRUE(orders->order(mission.vehicle)->nodes.back().released) << seed;
    }
  }
}

TEST(ControllerReleases, Places_WhenTheyAreOfAnotherPlan_ThenThatIsToldAndNothingGrows) {
  const FleetPlan plan = crossing();
  auto orders = FleetOrders::create(plan, kByController);
  Places places{{"v1", {}}, {"v2", {}}};
  orders->begin({}, places);
  const std::size_t before = *decision_point(*orders->order("v2"));
  places["v2"].left = static_cast<std::uint32_t>(polygons_of(plan.missions[1]));
  const Progress progress = orders->place(places, {});
  ASSERT_EQ(progress.wrong.size(), 1u);
  EXPECT_EQ(progress.wrong[0].code, "F0907");
  EXPECT_EQ(*decision_point(*orders->order("v2")), before);
}

TEST(ControllerReleases, FirstOrder_WhenTheVehicleIsUnderWay_ThenItBeginsWhereTheVehicleIs) {
  auto orders = FleetOrders::create(crossing(), kByController);
  const auto first =
      orders->begin({}, {{"v1", {.arc_m = 12.04, .left = 0}}, {"v2", {.arc_m = 34.0, .left = 0}}});
  ASSERT_EQ(first.size(), 1u);  // v2 is there
  EXPECT_NEAR(first[0].nodes[0].position->x_m, 28.0, 0.11);
  EXPECT_EQ(orders->passed("v1", 12.04, 0.15), 1u);
  EXPECT_EQ(orders->passed("v1", 30.0, 0.15), first[0].nodes.size());
  EXPECT_EQ(orders->passed("v2", 34.0, 0.15), 0u);
}

TEST(ControllerReleases, Replan_WhenOneGoesOnAndOneTurnsBack_ThenAnUpdateAndAfterTheCancellationANewOrder) {
  auto orders = FleetOrders::create(crossing(), kByController);
  Places places{{"v1", {}}, {"v2", {}}};
  const auto first = orders->begin({}, places);
  const FleetPlan next = support::scheduled(
      {eastwards().mission(),
       MadeMission("v2", {30, 10, kNorth}).drive(4.0, 0.0, geometry::Travel::Reverse).mission()});
  ASSERT_THAT(orders->affected(next, places), ElementsAre("v2"));
  EXPECT_FALSE(orders->adopt(next, {}, places));
  support::StandardVehicle vehicle("Stepwright", "v2");
  vehicle.take_order(to_json(first[1]));
  const auto cancel = orders->cancel("v2", {});
  ASSERT_TRUE(cancel);
  // It is lost; what goes out again has the same id.
  const auto again = orders->unconfirmed("v2", {});
  ASSERT_TRUE(again);
  EXPECT_EQ(again->actions[0].id, cancel->actions[0].id);
  EXPECT_NE(again->header.header_id, cancel->header.header_id);
  State busy = vehicle.state({});
  busy.actions.push_back({cancel->actions[0].id, "cancelOrder", ActionStatus::Running, {}});
  orders->take(busy, {});
  EXPECT_FALSE(orders->unconfirmed("v2", {}));  // it has come
  EXPECT_FALSE(orders->adopt(next, {}, places));
  vehicle.take_instant_actions(to_json(*again));
  orders->take(vehicle.state({}), {});
  EXPECT_EQ(orders->hold("v2"), Hold::Idle);
  const auto sent = orders->adopt(next, {}, {{"v1", {}}, {"v2", {.arc_m = 1.0, .left = 0}}});
  ASSERT_TRUE(sent);
  ASSERT_EQ(sent->size(), 2u);
  EXPECT_EQ((*sent)[0].order_id, first[0].order_id);
  EXPECT_EQ((*sent)[0].update_id, 1u);
  EXPECT_NE((*sent)[1].order_id, first[1].order_id);
  EXPECT_NEAR((*sent)[1].nodes[0].position->y_m, 9.0, 0.11);  // one metre back already
  EXPECT_TRUE(orders->sent((*sent)[1]));
  Order forged = (*sent)[1];
  forged.nodes.back().position->x_m += 1.0;
  EXPECT_FALSE(orders->sent(forged));
}

}  // namespace
}  // namespace stepwright::fleet::vda5050

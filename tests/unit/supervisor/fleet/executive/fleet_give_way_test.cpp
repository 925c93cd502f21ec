// A fleet that is at rest at a bad moment: no plan leads on from there unless somebody drives out of the way.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/unit/supervisor/fleet/executive/small_hall.h"

namespace stepwright::fleet {
namespace {

using namespace std::chrono_literals;

geometry::ConvexPolygon box(double x, double y, double width_m, double height_m) {
  return geometry::footprint_at({x, y + 0.5 * height_m, 0.0},
                                {.front_m = width_m, .rear_m = 0.0, .half_width_m = 0.5 * height_m});
}

// Between the left and the right half of the hall one aisle is left, too narrow to pass each other. Truck 1
// stands in it with the crate, for the right half, and truck 2 with the drum, for the left one.
class FaceToFace : public testing::Test {
 protected:
  FaceToFace() : ledger(hall.planning().problem()) {
    ledger.made(0, {.kind = StopKind::PickUp, .location = "dock A", .goal = "crate", .amount = 1}, 10s);
    ledger.made(1, {.kind = StopKind::PickUp, .location = "shelf 2", .goal = "drum", .amount = 1}, 10s);
    for (const std::size_t drive : {0U, 1U, 2U}) ledger.give_up_task(drive);
    request.rest = {.elapsed = 20s, .starts = hall.planning().first_starts()};
    request.rest.starts[0].start = {12.0, 3.0, 0.0};
    request.rest.starts[1].start = {22.0, 3.0, std::numbers::pi};
    request.blocked = {box(8.0, 4.6, 20.0, 2.6), box(10.0, 8.8, 2.0, 6.6), box(10.0, 16.8, 2.0, 7.0)};
  }

  SmallHall hall;
  FleetLedger ledger;
  FleetRequest request;
};

TEST_F(FaceToFace, WhenAllIsPlannedAnewFromRest_ThenOneGivesWayAndTheProgramDrivesThat) {
  const auto outcome = hall.planning().plan(ledger, request);
  ASSERT_TRUE(outcome) << result::to_string(outcome.error());
  ASSERT_TRUE(outcome->prepared.program) << outcome->reason;
  const FleetAnswer& answer = outcome->prepared.answer;
  // Truck 3 may have to as well: it stands on the way to dock B.
  const auto giver =
      std::ranges::find_if(answer.gave_way, [](const GaveWay& move) { return move.vehicle < 2; });
  ASSERT_NE(giver, answer.gave_way.end());
  EXPECT_LE(answer.gave_way.size(), 2U);
  const std::uint32_t v = giver->vehicle;
  const auto& stops = answer.plan.missions[v].stops;
  ASSERT_GE(stops.size(), 2U);
  EXPECT_EQ(stops[0].kind, StopKind::GiveWay);
  EXPECT_EQ(stops[1].kind, StopKind::SetDown);
  const auto& steps = outcome->prepared.program->missions[v].steps;
  EXPECT_TRUE(
      std::ranges::any_of(steps, [](const MissionStep& step) { return step.name == "S01_GIVE_WAY"; }));
}

// The numbers of a plan are those of all vehicles, also of the ones that are planned without.
TEST_F(FaceToFace, WhenOneIsLost_ThenWhoGivesWayIsNamedAllTheSame) {
  FleetLedger other(hall.planning().problem());
  for (const std::size_t drive : {0U, 1U, 2U}) other.give_up_task(drive);
  other.made(1, {.kind = StopKind::PickUp, .location = "shelf 2", .goal = "drum", .amount = 1}, 10s);
  other.made(2, {.kind = StopKind::PickUp, .location = "dock A", .goal = "crate", .amount = 1}, 10s);
  other.lose(0, "it has run into something");
  request.rest.starts[2].start = request.rest.starts[0].start;
  const geometry::Pose lost{22.0, 20.0, 0.0};
  request.standing = {{0, lost, geometry::footprint_at(lost, hall.planning().model(0).footprint())}};
  const auto outcome = hall.planning().plan(other, request);
  ASSERT_TRUE(outcome) << result::to_string(outcome.error());
  ASSERT_TRUE(outcome->prepared.program) << outcome->reason;
  const FleetAnswer& answer = outcome->prepared.answer;
  ASSERT_EQ(answer.gave_way.size(), 1U);
  EXPECT_NE(answer.gave_way[0].vehicle, 0U);
  const auto& stops = answer.plan.missions[answer.gave_way[0].vehicle].stops;
  EXPECT_TRUE(std::ranges::any_of(stops, [](const Stop& stop) { return stop.kind == StopKind::GiveWay; }));
}

// It is no drive that anybody has asked for.
TEST_F(FaceToFace, WhenAVehicleHasGivenWay_ThenItsDrivesAreStillToBeMade) {
  ledger.made(0, {.kind = StopKind::GiveWay, .location = "somewhere", .goal = {}}, 30s);
  EXPECT_EQ(ledger.vehicles()[0].tasks_done, 0U);
  EXPECT_TRUE(ledger.vehicles()[0].task_times.empty());
}

}  // namespace
}  // namespace stepwright::fleet

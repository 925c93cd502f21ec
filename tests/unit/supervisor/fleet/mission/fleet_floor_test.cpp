#include "supervisor/fleet/mission/fleet_floor.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/unit/supervisor/fleet/mission/small_floor.h"

namespace stepwright::fleet {
namespace {

constexpr geometry::Pose kLeft{6.0, 12.0, 0.0};
constexpr geometry::Pose kRight{34.0, 12.0, 0.0};
constexpr std::array<geometry::Pose, 1> kGoals = {kRight};

// What was worked out before a place became free is no lower bound any more: the way there would not be
// found.
TEST(FleetFloor, WhenPlacesBecomeFree_ThenWaysAreAsGoodAsIfCostsHadNeverBeenWorkedOut) {
  MissionProblem open = empty_problem();
  add_vehicle(open, "v1", kLeft);
  MissionProblem narrow = open;
  wall(narrow, 19.0, 4.0, 21.0, 24.0);  // past it below only
  FleetFloor fresh = floor_of(open);
  const double straight_m = fresh.plan({0, kLeft, kRight}, {.first_weight = 1.0}).path->length_m;
  FleetFloor floor = floor_of(narrow);
  floor.prepare_goals(0, kGoals);
  EXPECT_EQ(floor.prepared_goals(), 1U);
  EXPECT_GT(floor.plan({0, kLeft, kRight}, {.first_weight = 1.0}).path->length_m, straight_m + 1.0);
  floor.set_map(open.map);
  EXPECT_EQ(floor.prepared_goals(), 0U);
  EXPECT_NEAR(floor.plan({0, kLeft, kRight}, {.first_weight = 1.0}).path->length_m, straight_m, 1e-9);
}

TEST(FleetFloor, WhenPlacesAreBlocked_ThenCostsStayKnownAlsoWhenTheyAreFreeAgain) {
  MissionProblem open = empty_problem();
  add_vehicle(open, "v1", kLeft);
  MissionProblem narrow = open;
  wall(narrow, 19.0, 4.0, 21.0, 24.0);
  FleetFloor floor = floor_of(open);
  floor.prepare_goals(0, kGoals);
  for (const MissionProblem* problem : {&narrow, &open}) {
    floor.set_map(problem->map);
    EXPECT_EQ(floor.prepared_goals(), 1U);
    EXPECT_EQ(floor.plan({0, kLeft, kRight}, {}).end, PathEnd::Found);
  }
}

}  // namespace
}  // namespace stepwright::fleet

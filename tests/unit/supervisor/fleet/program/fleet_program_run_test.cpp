#include <gtest/gtest.h>

#include "supervisor/fleet/program/path_table.h"
#include "tests/unit/supervisor/fleet/program/fleet_rig.h"
#include "tests/unit/supervisor/fleet/program/planned_fleet.h"

namespace stepwright::fleet {
namespace {

TEST(FleetProgramRun, WhenSevenVehiclesDriveInTheMine_ThenAllArriveAndNobodyMeetsAnybody) {
  const support::DrawnFloor mine = support::draw_mine(1);
  const FleetPlan plan = plan_mine(7);
  FleetRig rig(plan, {.grid = &mine.grid});
  rig.run(400.0);
  EXPECT_TRUE(rig.all_arrived()) << rig.state();
  EXPECT_EQ(rig.overlaps, 0U) << rig.state();
  EXPECT_EQ(rig.wall_hits, 0U) << rig.state();
  EXPECT_TRUE(rig.engines_agree);
  std::printf("%s", rig.state().c_str());
  for (std::size_t v = 0; v < 7; ++v) std::printf("%zu: %.1f s, planned %.1f\n", v, rig.arrival_s[v], 1e-3 * double(plan.schedule.earliest[v].back().exit.count()));
}

}  // namespace
}  // namespace stepwright::fleet

#pragma once

// The cell of problem P1, a cup and a box between two arms, with its mission: the real planner, compiler,
// scan and plant in one thread. The judge is the plant's: whatever touches what it should not.
//
//   ArmsCell cell("(in cup1 box-top)");
//   const run::RunRecord record = cell.run(cell.options());
//   EXPECT_EQ(cell.contacts(), 0.0);

#include <string>
#include <vector>

#include "plant_models/assemblies/robot_cell_parameters.h"
#include "supervisor/tamp/mission/arms_mission.h"
#include "tests/support/controller/simulated_controller.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::tamp::mission::testing {

// The cell's file; kept for the tests of a process.
const scene::RobotCell& paper_cell();

class ArmsCell {
 public:
  explicit ArmsCell(const std::string& goal, std::vector<support::PlantFault> faults = {},
                    std::uint64_t seed = 1, std::vector<assemblies::FixedBody> blockages = {},
                    double following_rad = program::ArmsProgramOptions{}.following_rad);

  ArmsMissionOptions options() const { return {.cell = "arms", .attended = false}; }
  run::RunRecord run(ArmsMissionOptions options, ArmsMission::Observer observer = {});
  const ArmsPlanning& planning() const { return planning_; }
  support::SimulatedController& controller() { return controller_; }
  double truth(const std::string& name) const { return controller_.plant_value(name); }
  // Of all kinds, but for what an object that falls does.
  double contacts() const;
  std::filesystem::path journal() const { return folder_ / "arms.json"; }

 private:
  support::TemporaryFolder folder_;
  ArmsPlanning planning_;
  support::SimulatedController controller_;
};

// Phase, message and incidents, for messages of tests.
std::string story(const run::RunRecord& record);

}  // namespace stepwright::tamp::mission::testing

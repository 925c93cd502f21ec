#pragma once

// The cell of three vehicles with its real planner, compiler, scan and plant, in one thread. The judges are
// the plant's: exact outlines along the motion, contacts, where vehicles stand in the end.
//
//   SmallHall hall({{5.0, "dead_v2", 1.0}});
//   const run::RunRecord record = hall.run(hall.options());
//   hall.expect_clean();

#include <filesystem>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "supervisor/fleet/executive/fleet_executive.h"
#include "tests/support/controller/simulated_controller.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::fleet {

class SmallHall {
 public:
  // `constraints`: of the problem, as JSON; empty: the cell's own, which has none.
  explicit SmallHall(std::vector<support::PlantFault> faults = {}, const std::string& constraints = {});

  FleetExecutiveOptions options() const;
  run::RunRecord run(FleetExecutiveOptions options, FleetExecutive::Observer observer = {});
  // Made once for each problem: what it plans does not depend on what it has planned.
  FleetPlanning& planning();
  support::SimulatedController& controller() { return controller_; }
  // The executive looks at the clock every half second, also while nobody who rests causes an event.
  void tell_time();
  void expect_clean() const;
  double truth(const std::string& name) const { return controller_.plant_value(name); }

 private:
  support::TemporaryFolder folder_;
  config::CellConfig config_;
  std::string constraints_;
  support::SimulatedController controller_;
};

// Phase, message and incidents, for messages of tests.
std::string story(const run::RunRecord& record);
bool all_met(const run::RunRecord& record);
// When the service of a stop was over; below zero: it never was. `what`: "set_down 1 crate".
double finished_s(const run::RunRecord& record, const std::string& what);

}  // namespace stepwright::fleet

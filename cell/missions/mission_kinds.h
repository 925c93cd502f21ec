#pragma once

// The planner of a cell, by the list of planners (missions.def): opened from the cell's files, whichever it
// is, for the supervisor's process and for `stepwright check`.
//
//   auto planner = missions::open(config);              // what is wrong with the planner's files
//   auto mission = (*planner)->mission(controller, publish);
//   run::RunRecord record = mission->run();
//
// Threads: one uses a CellPlanner; a mission's are those of run::Mission.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/ground/result/result.h"
#include "supervisor/run/controller.h"
#include "supervisor/run/mission.h"

namespace stepwright::missions {

// The first plan of a cell, as the supervisor would make it at its start.
struct FirstPlan {
  std::size_t actions = 0;
  double cost = 0.0;
  std::vector<std::byte> program{};  // empty: there is no plan
  std::string no_plan{};             // why, although nothing is wrong with the files
  result::ExitCode exit = result::ExitCode::Done;
  result::Diagnostics warnings{};  // of the planner's files
};

// Everything that a mission needs but its controller. A mission must not outlive it.
class CellPlanner {
 public:
  virtual ~CellPlanner() = default;

  virtual std::unique_ptr<run::Mission> mission(run::Controller& controller,
                                                run::Mission::Observer observer) = 0;
  // Costs seconds. What is wrong with the cell's files, beyond what `open` has said.
  [[nodiscard]] virtual result::Result<FirstPlan> first_plan() = 0;
};

// What every mission has to know of its cell.
inline run::MissionOptions mission_options(const config::CellConfig& config) {
  return {.cell = config.name,
          .barrier = config.clock.mode == config::ClockMode::Simulated,
          .operator_starts = config.executive.start == config::RunStart::Operator};
}

// Reads all files; what is wrong with them. Requires that the cell names a planner.
[[nodiscard]] result::Result<std::unique_ptr<CellPlanner>> open(const config::CellConfig& config);

}  // namespace stepwright::missions

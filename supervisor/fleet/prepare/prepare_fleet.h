#pragma once

// From a fleet's problem to a program that a runtime takes: planned with a reserve for whatever drives it,
// scheduled with the times that the program will need, translated and compiled.
//
// One thread at a time for one floor. Among plans the same problem gives the same one, unless time ends.
//
//   const PrepareOptions options{.planning = {}, .program = {}, .terminals = terminals_in_a_row(6)};
//   auto floor = FleetFloor::create(problem.map, models_of(with_reserve(problem, options.reserve)), {});
//   auto prepared = prepare_fleet(problem, *floor, options);
//   if (prepared && prepared->program) download(prepared->container);

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "ladder/driver/watcher.h"
#include "runtime/ground/result/result.h"
#include "supervisor/fleet/mission/plan_fleet.h"
#include "supervisor/fleet/prepare/reserve.h"
#include "supervisor/fleet/program/fleet_program.h"

namespace stepwright::fleet {

struct PrepareOptions {
  FleetOptions planning;  // without `pace`
  ProgramOptions program;
  FleetTerminals terminals;  // of the problem's vehicles, in their order
  DriveReserve reserve;
};

struct PreparedFleet {
  FleetAnswer answer;                     // its missions have the vehicles' true outlines
  std::optional<FleetProgram> program;    // if there is a schedule
  std::vector<std::byte> container = {};  // of it
};

// The options with all that a program needs: missions take the time that it will take to drive them.
FleetOptions planning_options(const PrepareOptions& options);

// `floor` has the models of the problem with the reserve. Diagnostics: those of plan_fleet and fleet_program.
[[nodiscard]] result::Result<PreparedFleet> prepare_fleet(const MissionProblem& problem, FleetFloor& floor,
                                                          const PrepareOptions& options);

// The program of a plan that is there already, with programs that watch it.
[[nodiscard]] result::Result<std::vector<std::byte>> compile_fleet(
    const FleetProgram& program, std::span<const driver::Watcher> watchers = {});

}  // namespace stepwright::fleet

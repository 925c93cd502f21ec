#include "supervisor/fleet/prepare/prepare_fleet.h"

#include <utility>

#include "ladder/driver/compile.h"
#include "supervisor/fleet/program/driving_times.h"

namespace stepwright::fleet {

FleetOptions planning_options(const PrepareOptions& options) {
  FleetOptions planning = options.planning;
  planning.pace = [program = options.program](VehicleMission& mission) {
    if (!mission.path.empty()) set_driving_times(mission, program);
  };
  return planning;
}

result::Result<std::vector<std::byte>> compile_fleet(const FleetProgram& program,
                                                     std::span<const driver::Watcher> watchers) {
  auto compiled = driver::compile({.texts = {}, .projects = {&program.project}, .watchers = watchers});
  if (!compiled) return result::forward(compiled);
  return std::move(compiled->container);
}

result::Result<PreparedFleet> prepare_fleet(const MissionProblem& problem, FleetFloor& floor,
                                            const PrepareOptions& options) {
  auto answer = plan_fleet(with_reserve(problem, options.reserve), floor, planning_options(options));
  if (!answer) return result::forward(answer);
  PreparedFleet prepared{.answer = *std::move(answer), .program = {}};
  FleetPlan& plan = prepared.answer.plan;
  for (std::size_t v = 0; v < plan.missions.size(); ++v) {
    plan.missions[v].model = problem.classes[problem.vehicles[v].vehicle_class].model;
  }
  if (prepared.answer.verdict != Verdict::Scheduled) return prepared;
  auto program = fleet_program(plan, options.terminals, options.program);
  if (!program) return result::forward(program);
  auto container = compile_fleet(*program);
  if (!container) return result::forward(container);
  prepared.program = *std::move(program);
  prepared.container = *std::move(container);
  return prepared;
}

}  // namespace stepwright::fleet

#include "supervisor/fleet/executive/fleet_planning.h"

#include <algorithm>
#include <utility>

#include "runtime/ground/files/files.h"
#include "supervisor/fleet/executive/standing.h"
#include "supervisor/fleet/mission/problem_reader.h"
#include "supervisor/map/row_span.h"

namespace stepwright::fleet {
namespace {

// Of searches for orders; far more than the problems of a hall take. And of searches for other paths, where
// there is no order on the first ones.
constexpr std::uint64_t kConflicts = 20'000;
constexpr std::uint64_t kExpansions = 1'000'000;
// So many vehicles at most drive out of the way of others first. Places where they can are counted too.
constexpr std::uint32_t kGiveWay = 3;

// "goals[3]" of the key with which a diagnostic begins.
std::optional<std::size_t> named(const std::string& message, const std::vector<std::string>& keys) {
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (message.starts_with(keys[k] + ":")) return k;
  }
  return std::nullopt;
}

// Loads that are aboard have been picked up: the stop at which the plan has them begin is none.
void remove_begun(VehicleMission& mission, const std::string& location) {
  for (std::size_t k = mission.stops.size(); k-- > 0;) {
    if (mission.stops[k].location != location) continue;
    mission.stops.erase(mission.stops.begin() + static_cast<std::ptrdiff_t>(k));
    mission.grown.stands.erase(mission.grown.stands.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

}  // namespace

FleetPlanning::FleetPlanning(FleetPlanningOptions options, MissionProblem problem, FleetFloor floor)
    : options_(std::move(options)), problem_(std::move(problem)), floor_(std::move(floor)) {}

result::Result<FleetPlanning> FleetPlanning::open(const FleetPlanningOptions& options) {
  auto text = files::read_file(options.problem.string());
  if (!text) return result::forward(text);
  auto problem = read_mission_problem(*text, options.problem);
  if (!problem) return result::forward(problem);
  for (const MissionVehicle& vehicle : problem->vehicles) {
    if (!vehicle.path && !vehicle.envelope) continue;
    return result::fail("F1107", place_of(*problem, vehicle.key),
                        "'" + vehicle.name + "' has a path or an envelope of its own",
                        "a vehicle that is planned for again and again has a start");
  }
  if (options.terminals.vehicles.size() != problem->vehicles.size()) {
    return result::fail("F1105", {options.problem.string(), 0, 0},
                        "terminals of " + std::to_string(options.terminals.vehicles.size()) +
                            " vehicles for a problem of " + std::to_string(problem->vehicles.size()));
  }
  auto floor = FleetFloor::create(problem->map, models_of(with_reserve(*problem, options.reserve)),
                                  {.table_folder = options.cache});
  if (!floor) return result::forward(floor);
  return FleetPlanning(options, *std::move(problem), *std::move(floor));
}

std::vector<NewStart> FleetPlanning::first_starts() const {
  std::vector<NewStart> starts;
  for (const MissionVehicle& vehicle : problem_.vehicles) starts.push_back({.start = vehicle.start});
  return starts;
}

OccupancyGrid FleetPlanning::floor_with(const std::vector<Standing>& standing,
                                        const std::vector<geometry::ConvexPolygon>& blocked) const {
  OccupancyGrid map = problem_.map;
  for (const Standing& each : standing) block(map, each.place);
  for (const geometry::ConvexPolygon& area : blocked) block(map, area);
  return map;
}

result::Result<FleetOutcome> FleetPlanning::plan(const FleetLedger& ledger, const FleetRequest& request) {
  FleetOutcome outcome;
  outcome.rest = ledger.rest(request.rest);
  MissionProblem& problem = outcome.rest.problem;
  problem.map = floor_with(request.standing, request.blocked);
  std::vector<std::string> goal_keys;
  for (std::size_t k = 0; k < problem.goals.size(); ++k) {
    problem.goals[k].key = "goals[" + std::to_string(k) + "]";
    goal_keys.push_back(problem.goals[k].key);
  }
  std::vector<std::string> task_keys;
  for (std::size_t k = 0; k < problem.tasks.size(); ++k) {
    problem.tasks[k].key = "tasks[" + std::to_string(k) + "]";
    task_keys.push_back(problem.tasks[k].key);
  }
  floor_.set_map(problem.map);
  PrepareOptions prepare{
      .planning = {}, .program = options_.program, .terminals = {}, .reserve = options_.reserve};
  prepare.planning.time = options_.time;
  prepare.planning.path_factor = options_.path_factor;
  prepare.planning.conflicts = kConflicts;
  prepare.planning.expansions = kExpansions;
  prepare.planning.give_way = kGiveWay;
  prepare.planning.cancel = request.cancel;
  auto answer = plan_fleet(with_reserve(problem, options_.reserve), floor_, planning_options(prepare));
  if (!answer) {
    for (const result::Diagnostic& wrong : answer.error()) {
      const auto goal = named(wrong.message, goal_keys);
      const auto task = named(wrong.message, task_keys);
      if (goal) outcome.no_way_to.push_back(no_way(outcome.rest, *goal));
      if (task) outcome.no_way_to_task.push_back(outcome.rest.tasks[*task]);
    }
    outcome.reason = result::to_string(answer.error());
    return outcome;
  }
  if (answer->verdict != Verdict::Scheduled) {
    outcome.reason = answer->reason.empty() ? "no plan was found" : answer->reason;
    outcome.prepared.answer = *std::move(answer);
    return outcome;
  }
  for (PathChange& change : answer->changes) {
    change.vehicle = outcome.rest.vehicles[change.vehicle];
    for (std::uint32_t& other : change.around) other = outcome.rest.vehicles[other];
  }
  for (GaveWay& move : answer->gave_way) move.vehicle = outcome.rest.vehicles[move.vehicle];
  FleetPlan plan = std::move(answer->plan);
  for (std::size_t k = 0; k < plan.missions.size(); ++k) {
    plan.missions[k].model = model(outcome.rest.vehicles[k]);
    remove_begun(plan.missions[k], "aboard " + plan.missions[k].vehicle);
  }
  for (const Standing& each : request.standing) {
    insert_standing(plan, each.vehicle, problem_.vehicles[each.vehicle].name, model(each.vehicle), each.pose,
                    each.place);
  }
  auto prepared = program_of(std::move(plan), request.revision);
  if (!prepared) return result::forward(prepared);
  answer->plan = std::move(prepared->answer.plan);
  prepared->answer = *std::move(answer);
  outcome.prepared = *std::move(prepared);
  return outcome;
}

result::Result<PreparedFleet> FleetPlanning::program_of(FleetPlan plan, std::uint32_t revision,
                                                        ErrorReset reset) const {
  ProgramOptions options = options_.program;
  options.reset = std::move(reset);
  options.revision = revision;
  auto program = fleet_program(plan, options_.terminals, options);
  if (!program) return result::forward(program);
  auto container = compile_fleet(*program, options_.watchers);
  if (!container) return result::forward(container);
  PreparedFleet prepared;
  prepared.answer.verdict = Verdict::Scheduled;
  prepared.answer.plan = std::move(plan);
  prepared.program = *std::move(program);
  prepared.container = *std::move(container);
  return prepared;
}

// What is aboard begins where its vehicle does, at a location that the rest alone has.
NoWay FleetPlanning::no_way(const RestProblem& rest, std::size_t goal) const {
  const MissionGoal& of = rest.problem.goals[goal];
  NoWay part{.goal = rest.goals[goal], .aboard_of = {}};
  if (of.from >= problem_.locations.size() && of.vehicle) part.aboard_of = rest.vehicles[*of.vehicle];
  return part;
}

}  // namespace stepwright::fleet

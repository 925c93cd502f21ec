#pragma once

// The whole chain from a problem to scheduled envelopes: which vehicle carries what (allocation), on which
// paths (lattice), within which polygons (envelopes), and who goes first (schedule). After Pecora and Cirillo
// 2012, whose four modules work on one set of constraints; each may be left out by hand: fixed vehicles and
// routes, drawn paths, given envelopes.
//
// Where paths leave no schedule, paths of the vehicles to blame are planned anew around what they meet,
// cheapest first, a bounded number of times. Where that does not help and FleetOptions::give_way allows it,
// vehicles drive out of the way of others first, as few as possible. Where nothing helps the answer is the
// proof for the first paths, or for all paths, if there is one (FleetAnswer::proof).
//
// The same problem and options give the same plan unless time ends or somebody cancels. One thread at a time
// for one floor.
//
//   auto floor = FleetFloor::create(problem->map, models_of(*problem), {});
//   const auto answer = plan_fleet(*problem, *floor, {.time = 5s});
//   if (answer && answer->verdict == Verdict::Scheduled) drive(answer->plan);

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "supervisor/fleet/allocation/allocate.h"
#include "supervisor/fleet/mission/fleet_floor.h"
#include "supervisor/fleet/mission/mission_problem.h"
#include "supervisor/fleet/plan/fleet_plan.h"
#include "supervisor/fleet/schedule/problem_file.h"

namespace stepwright::fleet {

struct FleetProgress {
  std::string_view stage;  // "paths"
  std::size_t done = 0;    // sets of paths tried, of most `alternatives`; otherwise 0
  double wall_ms = 0.0;
};

struct FleetOptions {
  Mode mode = Mode::Strict;
  Objective objective = Objective::Makespan;  // None: the first schedule
  std::chrono::milliseconds time{10'000};     // of everything; improving ends with it. Zero: no limit
  // Of the search for each set of paths, with ARA* from weight 3 on. Zero: A*, without a limit.
  std::chrono::milliseconds path_time{0};
  double path_factor = 1.0;  // paths that are proved to cost at most so many times the least will do
  std::uint32_t alternatives =
      48;                      // paths planned anew, at most, where there is no schedule; places to give way
  std::uint32_t give_way = 0;  // so many vehicles at most drive out of the way of others first
  // Budgets that are the same on every machine; 0: none. Of a search for orders: for the first ones, for
  // better ones, and for all those together that are looked for with other paths; and of the searches for
  // these paths.
  std::uint64_t conflicts = 0;
  std::uint64_t expansions = 0;
  EnvelopeOptions envelope{};  // but for the speeds, which each vehicle has its own
  AllocationObjective allocation{};
  // Puts what a mission's polygons take at least to what they will take (supervisor/fleet/program knows);
  // from several threads. Empty: ways at greatest speed.
  std::function<void(VehicleMission&)> pace = {};
  std::function<void(const FleetProgress&)> on_progress = {};  // called now and then, from this thread
  const std::atomic<bool>* cancel = nullptr;                   // not owned; may be null
};

struct FleetFigures {
  double allocation_ms = 0.0;  // driving times included
  double paths_ms = 0.0;
  double envelopes_ms = 0.0;
  double schedule_ms = 0.0;  // the first one
  double repair_ms = 0.0;    // paths planned anew, and their schedules
  double improve_ms = 0.0;
  double total_ms = 0.0;
  std::size_t searches = 0;  // of paths
  std::size_t alternatives = 0;
};

// A path that was planned anew, and around what.
struct PathChange {
  std::uint32_t vehicle = 0;
  std::vector<std::uint32_t> around;  // vehicles
  double longer_m = 0.0;
};

// A vehicle that first drives out of the way of others, and where it stands then.
struct GaveWay {
  std::uint32_t vehicle = 0;
  geometry::Pose place;
};

// Of what Infeasible is proved.
enum class Proof : std::uint8_t {
  None,            // the verdict is another one
  ThisAllocation,  // of the first paths, with loads shared out as they are
  PathsFound,      // of the paths found, however loads are shared out
  AllPaths,        // of all paths of the lattice, however loads are shared out: there is no plan
};

struct FleetAnswer {
  Verdict verdict = Verdict::Exhausted;
  Proof proof = Proof::None;
  // Missions are there unless there is no allocation; the schedule says what became of it.
  FleetPlan plan;
  std::optional<AllocationAnswer> allocation;  // if there are goals
  std::vector<PathChange> changes;
  std::vector<GaveWay> gave_way;
  std::string reason;  // without a schedule: why, a sentence a line
  FleetFigures figures;
};

// One for each class of the problem, in their order.
std::vector<VehicleModel> models_of(const MissionProblem& problem);

// `floor` has the models of the problem. Diagnostics are of what is wrong with the problem although it can be
// read: F0801 no vehicle finds its way from a place to another, F0802 a given path meets an obstacle.
[[nodiscard]] result::Result<FleetAnswer> plan_fleet(const MissionProblem& problem, FleetFloor& floor,
                                                     const FleetOptions& options);

// The scheduler alone: envelopes and constraints are all that is known. Its proofs are of everything.
FleetAnswer schedule_fleet(const SchedulingProblem& problem, const FleetOptions& options);

}  // namespace stepwright::fleet

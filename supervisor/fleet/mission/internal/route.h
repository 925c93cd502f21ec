#pragma once

// Route of a vehicle: its stops, as the chain hands them from allocation to paths. Values.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "supervisor/fleet/allocation/allocate.h"
#include "supervisor/fleet/mission/fleet_floor.h"
#include "supervisor/fleet/mission/mission_problem.h"
#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet::internal {

struct RouteStop {
  StopKind kind = StopKind::Park;
  std::size_t location = 0;
  std::optional<std::size_t> goal;
  std::optional<std::size_t> task;
  std::uint32_t amount = 0;
  std::uint32_t aboard = 0;
};

using Route = std::vector<RouteStop>;

// A vehicle that is planned for, not one whose path or envelope is given.
inline bool is_planned(const MissionVehicle& vehicle) {
  return !vehicle.path && !vehicle.envelope;
}

// The legs of a route, from the vehicle's start on.
std::vector<LegRequest> legs_of(const MissionProblem& problem, std::size_t vehicle, const Route& route);

// The allocation problem of a mission problem, and the routes of its answer by vehicle.
//
// Driving times begin as lower bounds. The legs that an allocation uses are planned on the lattice, and the
// problem is solved again with their exact times, until it uses only exact legs. An allocation that is best
// under lower bounds and uses none of them is best.
enum class LegTimes : std::uint8_t {
  Paths,         // of the paths that are known; the least there can be where none is
  LeastOnPaths,  // the same, less all that a schedule can gain by rounding: see least_leg_ms
  Least,         // no path of the lattice takes less, with the same taken off
};

class AllocationTask {
 public:
  AllocationTask(const MissionProblem& problem, FleetFloor& floor, const AllocationObjective& objective,
                 const std::atomic<bool>* cancel);

  const AllocationProblem& problem() const { return asked_; }
  // Updates the problem's times. False if no leg has become known since the last call.
  bool learn(LegTimes times);
  // F0801 for goals of which the floor knows that no vehicle that may carry them finds its way, and for tasks
  // to which there is none.
  result::Diagnostics unreachable() const;
  std::vector<Route> routes(const AllocationAnswer& answer) const;
  // Where in the file the constraints of a conflict stand, a line each.
  std::string places_of(const AllocationConflict& conflict) const;

 private:
  LocationId start_of(std::size_t vehicle) const;
  std::optional<TransportTimepoint> timepoint(const MomentRef& moment) const;
  LegRequest leg(std::size_t model, std::size_t from, std::size_t to) const;
  void add_classes();
  void find_least_ways(std::size_t model);
  void add_vehicles();
  void add_transports();
  void add_constraints();

  const MissionProblem& mission_;
  const FleetFloor& floor_;
  const std::atomic<bool>* cancel_;
  AllocationProblem asked_;
  std::vector<std::size_t> vehicles_;                    // of the problem, by vehicle of the allocation
  std::vector<std::optional<std::size_t>> carriers_;     // the other way round
  std::vector<std::pair<std::size_t, double>> classes_;  // model and greatest speed
  // By class: the pairs of places that it may drive, and how far that is at least.
  std::vector<std::set<std::pair<std::size_t, std::size_t>>> pairs_;
  std::vector<std::map<std::pair<std::size_t, std::size_t>, double>> ways_m_;
  std::size_t known_ = 0;                     // pairs with exact times
  std::vector<std::string> constraint_keys_;  // of the problem, by constraint of the allocation
};

// How long a leg takes in every schedule, at least. Its polygons' times are whole milliseconds, rounded so
// that each by itself is driven no faster than the vehicle can; their sum may be less than the way takes by
// up to a millisecond for each polygon, of which there is at most one for each pose. Known: of the path that
// the floor knows, if it does.
std::chrono::milliseconds least_leg_time(const FleetFloor& floor, const LegRequest& leg, double least_way_m,
                                         double speed_mps, bool known);

// The stops of the tasks, behind those of the goals.
void append_tasks(const MissionProblem& problem, std::vector<Route>& routes);

}  // namespace stepwright::fleet::internal

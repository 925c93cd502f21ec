#include "supervisor/fleet/mission/internal/route.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "supervisor/fleet/envelope/time_bounds.h"
#include "supervisor/fleet/mission/internal/parallel.h"

namespace stepwright::fleet::internal {

std::vector<LegRequest> legs_of(const MissionProblem& problem, std::size_t vehicle, const Route& route) {
  std::vector<LegRequest> legs;
  geometry::Pose at = problem.vehicles[vehicle].start;
  for (const RouteStop& stop : route) {
    const geometry::Pose& next = problem.locations[stop.location].pose;
    legs.push_back({problem.vehicles[vehicle].vehicle_class, at, next});
    at = next;
  }
  return legs;
}

std::chrono::milliseconds least_leg_time(const FleetFloor& floor, const LegRequest& leg, double least_way_m,
                                         double speed_mps, bool known) {
  const PathAnswer* answer = known ? floor.find(leg) : nullptr;
  double least_ms = 0.0;
  if (answer != nullptr && answer->path) {
    least_ms = 1000.0 * answer->path->length_m / speed_mps - static_cast<double>(answer->path->poses.size());
  } else {
    // A longer way has more poses, too; so it takes longer, or it is not known to take any time.
    least_ms = least_way_m * (1000.0 / speed_mps - floor.planner(leg.model).most_poses_per_m()) - 1.0;
  }
  const auto horizon_ms = static_cast<double>(SpeedLimits{}.horizon.count());
  return std::chrono::milliseconds(static_cast<std::int64_t>(std::clamp(least_ms, 0.0, horizon_ms)));
}

// Locations of the allocation are those of the problem, then the starts of its vehicles.
AllocationTask::AllocationTask(const MissionProblem& problem, FleetFloor& floor,
                               const AllocationObjective& objective, const std::atomic<bool>* cancel)
    : mission_(problem), floor_(floor), cancel_(cancel), carriers_(problem.vehicles.size()) {
  asked_.objective = objective;
  for (const MissionLocation& location : problem.locations) asked_.locations.push_back(location.name);
  for (const MissionVehicle& vehicle : problem.vehicles) {
    asked_.locations.push_back("the start of " + vehicle.name);
  }
  for (std::size_t v = 0; v < problem.vehicles.size(); ++v) {
    const MissionVehicle& vehicle = problem.vehicles[v];
    if (!is_planned(vehicle) || vehicle.capacity == 0) continue;
    carriers_[v] = vehicles_.size();
    vehicles_.push_back(v);
  }
  add_classes();
  add_vehicles();
  add_transports();
  add_constraints();
}

LocationId AllocationTask::start_of(std::size_t vehicle) const {
  return LocationId(static_cast<std::uint32_t>(mission_.locations.size() + vehicle));
}

LegRequest AllocationTask::leg(std::size_t model, std::size_t from, std::size_t to) const {
  const auto pose = [&](std::size_t location) {
    return location < mission_.locations.size()
               ? mission_.locations[location].pose
               : mission_.vehicles[location - mission_.locations.size()].start;
  };
  return {model, pose(from), pose(to)};
}

// Between the places of goals, from starts to pick-ups, from set-downs to where tasks begin.
void AllocationTask::add_classes() {
  std::set<std::size_t> places;
  for (const MissionGoal& goal : mission_.goals) {
    places.insert(goal.from);
    places.insert(goal.to);
  }
  for (const std::size_t v : vehicles_) {
    const MissionVehicle& vehicle = mission_.vehicles[v];
    const std::pair key{vehicle.vehicle_class, vehicle.speed.max_mps};
    if (std::ranges::find(classes_, key) == classes_.end()) classes_.push_back(key);
  }
  for (const auto& [model, speed_mps] : classes_) {
    auto& pairs = pairs_.emplace_back();
    for (const std::size_t from : places) {
      for (const std::size_t to : places) {
        if (from != to) pairs.emplace(from, to);
      }
    }
    for (const std::size_t v : vehicles_) {
      if (mission_.vehicles[v].vehicle_class != model) continue;
      for (const MissionGoal& goal : mission_.goals) pairs.emplace(start_of(v).value, goal.from);
      for (const MissionTask& task : mission_.tasks) {
        if (task.vehicle != v) continue;
        pairs.emplace(start_of(v).value, task.location);
        for (const MissionGoal& goal : mission_.goals) {
          if (goal.to != task.location) pairs.emplace(goal.to, task.location);
        }
      }
    }
    find_least_ways(model);
    asked_.classes.emplace_back(asked_.locations.size());
  }
  learn(LegTimes::Paths);
}

// One search of the floor for each place to which somebody drives.
void AllocationTask::find_least_ways(std::size_t model) {
  std::map<std::size_t, std::vector<std::size_t>> by_goal;
  for (const auto& [from, to] : pairs_.back()) by_goal[to].push_back(from);
  const std::vector<std::pair<std::size_t, std::vector<std::size_t>>> all(by_goal.begin(), by_goal.end());
  std::vector<std::vector<double>> found(all.size());
  each_index(all.size(), floor_.threads(), [&](std::size_t k) {
    std::vector<geometry::Pose> from;
    for (const std::size_t place : all[k].second) from.push_back(leg(model, place, all[k].first).from);
    found[k] = floor_.planner(model).least_ways_m(from, leg(model, 0, all[k].first).to, cancel_);
  });
  auto& ways_m = ways_m_.emplace_back();
  for (std::size_t k = 0; k < all.size(); ++k) {
    for (std::size_t i = 0; i < found[k].size(); ++i) {
      ways_m[{all[k].second[i], all[k].first}] = found[k][i];
    }
  }
}

bool AllocationTask::learn(LegTimes wanted) {
  std::size_t known = 0;
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    TravelTimes times(asked_.locations.size());
    for (const auto& pair : pairs_[c]) {
      const LegRequest way = leg(classes_[c].first, pair.first, pair.second);
      const PathAnswer* answer = floor_.find(way);
      if (answer != nullptr) ++known;
      // No path of the lattice, not only none that was found in time.
      if (answer != nullptr && (answer->end == PathEnd::Unreachable || answer->end == PathEnd::Refused))
        continue;
      const double speed_mps = classes_[c].second;
      const double least_m = ways_m_[c].at(pair);
      const double length_m = answer != nullptr && answer->path ? answer->path->length_m : least_m;
      const auto time =
          wanted == LegTimes::Paths
              ? time_bounds(length_m, {.min_mps = 0.0, .max_mps = speed_mps}).least
              : least_leg_time(floor_, way, least_m, speed_mps, wanted == LegTimes::LeastOnPaths);
      times.set(LocationId(static_cast<std::uint32_t>(pair.first)),
                LocationId(static_cast<std::uint32_t>(pair.second)), time);
    }
    asked_.classes[c] = std::move(times);
  }
  return std::exchange(known_, known) != known;
}

void AllocationTask::add_vehicles() {
  for (const std::size_t v : vehicles_) {
    const MissionVehicle& vehicle = mission_.vehicles[v];
    const auto at = std::ranges::find(classes_, std::pair{vehicle.vehicle_class, vehicle.speed.max_mps});
    TransportVehicle added{.name = vehicle.name,
                           .vehicle_class = static_cast<std::uint32_t>(at - classes_.begin()),
                           .start = start_of(v),
                           .capacity = vehicle.capacity,
                           .available = vehicle.available};
    const auto task = std::ranges::find(mission_.tasks, v, &MissionTask::vehicle);
    if (task != mission_.tasks.end()) added.finish = LocationId(static_cast<std::uint32_t>(task->location));
    asked_.vehicles.push_back(std::move(added));
    if (vehicle.route.empty()) continue;
    FixedRoute route{.vehicle = VehicleId(static_cast<std::uint32_t>(asked_.vehicles.size() - 1)),
                     .stops = {},
                     .whole = vehicle.route_is_whole};
    for (const HandStop& stop : vehicle.route) {
      route.stops.push_back({stop.pick_up ? LoadAction::PickUp : LoadAction::SetDown,
                             TransportId(static_cast<std::uint32_t>(stop.goal)), stop.amount});
    }
    asked_.routes.push_back(std::move(route));
  }
}

void AllocationTask::add_transports() {
  for (std::size_t k = 0; k < mission_.goals.size(); ++k) {
    const MissionGoal& goal = mission_.goals[k];
    Transport transport{.name = goal.name,
                        .amount = goal.amount,
                        .from = LocationId(static_cast<std::uint32_t>(goal.from)),
                        .to = LocationId(static_cast<std::uint32_t>(goal.to)),
                        .pick_up_service = mission_.locations[goal.from].service,
                        .set_down_service = mission_.locations[goal.to].service,
                        .divisible = goal.divisible};
    if (goal.vehicle)
      transport.vehicle = VehicleId(static_cast<std::uint32_t>(carriers_[*goal.vehicle].value()));
    transport.due = goal.due;
    if (goal.due && asked_.objective.tardiness == 0) asked_.objective.tardiness = asked_.objective.makespan;
    asked_.transports.push_back(std::move(transport));
    for (const std::size_t before : goal.after) {
      asked_.orders.push_back(
          {TransportId(static_cast<std::uint32_t>(before)), TransportId(static_cast<std::uint32_t>(k))});
    }
  }
}

std::optional<TransportTimepoint> AllocationTask::timepoint(const MomentRef& at) const {
  switch (at.moment) {
    case Moment::TimeZero:
      return TransportTimepoint{};
    case Moment::GoalStart:
      return fleet::start_of(TransportId(static_cast<std::uint32_t>(at.index)));
    case Moment::GoalEnd:
      return end_of(TransportId(static_cast<std::uint32_t>(at.index)));
    case Moment::VehicleStart:
      if (!carriers_[at.index]) return std::nullopt;
      return fleet::start_of(VehicleId(static_cast<std::uint32_t>(*carriers_[at.index])));
    default:
      return std::nullopt;  // the scheduler sees to these
  }
}

void AllocationTask::add_constraints() {
  for (const MissionConstraint& constraint : mission_.constraints) {
    const auto from = timepoint(constraint.from);
    const auto to = timepoint(constraint.to);
    if (!from || !to) continue;
    constraint_keys_.push_back(constraint.key);
    asked_.constraints.push_back({.name = constraint.name,
                                  .from = *from,
                                  .to = *to,
                                  .distance = {constraint.distance.least, constraint.distance.most}});
  }
}

result::Diagnostics AllocationTask::unreachable() const {
  result::Diagnostics found;
  for (std::size_t k = 0; k < mission_.goals.size(); ++k) {
    const MissionGoal& goal = mission_.goals[k];
    std::string reason;
    bool reached = false;
    for (const std::size_t v : vehicles_) {
      if (reached || (goal.vehicle && *goal.vehicle != v)) continue;
      const std::size_t model = mission_.vehicles[v].vehicle_class;
      reached = true;
      for (const LegRequest& way :
           {leg(model, mission_.locations.size() + v, goal.from), leg(model, goal.from, goal.to)}) {
        const PathAnswer* answer = floor_.find(way);
        if (answer == nullptr || answer->diagnostics.empty()) continue;
        reached = false;
        reason = answer->diagnostics.front().message;
      }
    }
    if (reached) continue;
    found.push_back(
        {"F0801",
         result::Severity::Error,
         place_of(mission_, goal.key),
         fmt::format("{}: no vehicle reaches '{}' and from there '{}': {}", goal.key,
                     mission_.locations[goal.from].name, mission_.locations[goal.to].name, reason),
         {}});
  }
  for (const MissionTask& task : mission_.tasks) {
    for (std::size_t from = 0; from < asked_.locations.size(); ++from) {
      const std::size_t model = mission_.vehicles[task.vehicle].vehicle_class;
      const PathAnswer* answer = floor_.find(leg(model, from, task.location));
      if (answer == nullptr || answer->diagnostics.empty()) continue;
      found.push_back({"F0801",
                       result::Severity::Error,
                       place_of(mission_, task.key),
                       fmt::format("{}: '{}' finds no way: {}", task.key,
                                   mission_.vehicles[task.vehicle].name, answer->diagnostics.front().message),
                       {}});
      break;
    }
  }
  return found;
}

std::vector<Route> AllocationTask::routes(const AllocationAnswer& answer) const {
  std::vector<Route> routes(mission_.vehicles.size());
  for (std::size_t k = 0; k < answer.routes.size(); ++k) {
    for (const fleet::RouteStop& stop : answer.routes[k].stops) {
      routes[vehicles_[k]].push_back(
          {.kind = stop.action == LoadAction::PickUp ? StopKind::PickUp : StopKind::SetDown,
           .location = stop.location.value,
           .goal = stop.transport.value,
           .task = {},
           .amount = stop.amount,
           .aboard = stop.aboard});
    }
  }
  return routes;
}

std::string AllocationTask::places_of(const AllocationConflict& conflict) const {
  std::string text;
  for (const std::uint32_t k : conflict.constraints) {
    const result::Location where = place_of(mission_, constraint_keys_.at(k));
    if (where.line == 0) continue;
    text += fmt::format("{}:{}:{}: {}\n", where.file, where.line, where.column, asked_.constraints[k].name);
  }
  return text;
}

void append_tasks(const MissionProblem& problem, std::vector<Route>& routes) {
  for (std::size_t k = 0; k < problem.tasks.size(); ++k) {
    const MissionTask& task = problem.tasks[k];
    routes[task.vehicle].push_back(
        {.kind = StopKind::Park, .location = task.location, .goal = {}, .task = k, .amount = 0, .aboard = 0});
  }
}

}  // namespace stepwright::fleet::internal

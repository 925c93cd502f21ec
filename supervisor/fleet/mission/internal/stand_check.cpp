#include "supervisor/fleet/mission/internal/stand_check.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <set>

#include "supervisor/fleet/lattice/heading.h"
#include "supervisor/fleet/lattice/swept_cells.h"
#include "supervisor/map/row_span.h"

namespace stepwright::fleet::internal {

namespace {

using geometry::Pose;

geometry::ConvexPolygon with_room(const VehicleModel& model, const Pose& pose, double room_m) {
  geometry::Footprint outline = model.footprint();
  outline.front_m += room_m;
  outline.rear_m += room_m;
  outline.half_width_m += room_m;
  return footprint_at(pose, outline);
}

std::string extent(const GridFrame& frame) {
  const geometry::Point high = frame.corner({frame.columns, frame.rows});
  return fmt::format("the map reaches from ({:.2f} m, {:.2f} m) to ({:.2f} m, {:.2f} m)", frame.origin.x_m,
                     frame.origin.y_m, high.x_m, high.y_m);
}

bool moves(const MissionVehicle& vehicle) {
  return !vehicle.envelope && !vehicle.path;
}

// The classes of vehicles of which one at least must be able to stand at each location; all where a vehicle
// is fixed.
struct Users {
  std::set<std::size_t> any;
  std::set<std::size_t> all;
};

std::vector<Users> users_of(const MissionProblem& problem) {
  std::vector<Users> users(problem.locations.size());
  for (const MissionGoal& goal : problem.goals) {
    for (const std::size_t location : {goal.from, goal.to}) {
      if (goal.vehicle) {
        users[location].all.insert(problem.vehicles[*goal.vehicle].vehicle_class);
        continue;
      }
      for (const MissionVehicle& vehicle : problem.vehicles) {
        if (moves(vehicle) && vehicle.capacity > 0) users[location].any.insert(vehicle.vehicle_class);
      }
    }
  }
  for (const MissionTask& task : problem.tasks) {
    users[task.location].all.insert(problem.vehicles[task.vehicle].vehicle_class);
  }
  return users;
}

void check_locations(const MissionProblem& problem, JsonComplaints& complaints) {
  const std::vector<Users> users = users_of(problem);
  for (std::size_t k = 0; k < problem.locations.size(); ++k) {
    const MissionLocation& location = problem.locations[k];
    std::string reason;
    bool one_can = users[k].any.empty();
    for (const std::size_t c : users[k].any) {
      const std::string found = in_the_way(problem.map, problem.classes[c].model, location.pose);
      one_can = one_can || found.empty();
      if (!found.empty()) reason = found;
    }
    for (const std::size_t c : users[k].all) {
      const std::string found = in_the_way(problem.map, problem.classes[c].model, location.pose);
      if (found.empty()) continue;
      one_can = false;
      reason = found;
    }
    if (one_can) continue;
    complaints.add("F0707", location.key,
                   fmt::format("no vehicle can stand at '{}': {}", location.name, reason),
                   extent(problem.map.frame()));
  }
}

void check_starts(const MissionProblem& problem, JsonComplaints& complaints) {
  std::vector<std::optional<geometry::ConvexPolygon>> outlines;
  for (std::size_t v = 0; v < problem.vehicles.size(); ++v) {
    const MissionVehicle& vehicle = problem.vehicles[v];
    outlines.emplace_back();
    if (vehicle.envelope) continue;
    const VehicleModel& model = problem.classes[vehicle.vehicle_class].model;
    const Pose pose = vehicle.path ? vehicle.path->front().pose : on_lattice(problem.map, vehicle.start);
    if (moves(vehicle)) {
      const std::string reason = in_the_way(problem.map, model, vehicle.start);
      if (!reason.empty()) {
        complaints.add("F0707", vehicle.key + ".start",
                       fmt::format("'{}' cannot stand there: {}", vehicle.name, reason),
                       extent(problem.map.frame()));
      }
    }
    outlines.back() = footprint_at(pose, model.footprint());
    for (std::size_t other = 0; other < v; ++other) {
      if (!outlines[other] || !overlaps(*outlines[other], *outlines[v])) continue;
      complaints.add(
          "F0707", vehicle.key + (vehicle.path ? ".path" : ".start"),
          fmt::format("'{}' begins where '{}' stands", vehicle.name, problem.vehicles[other].name));
    }
  }
}

}  // namespace

Pose on_lattice(const OccupancyGrid& map, const Pose& pose) {
  const geometry::Point origin = map.frame().origin;
  return {origin.x_m + kLattice_m * std::round((pose.x_m - origin.x_m) / kLattice_m),
          origin.y_m + kLattice_m * std::round((pose.y_m - origin.y_m) / kLattice_m),
          heading_rad(nearest_heading(pose.heading_rad))};
}

std::string in_the_way(const OccupancyGrid& map, const VehicleModel& model, const Pose& pose) {
  const GridFrame& frame = map.frame();
  if (!map.contains(frame.cell_at(pose.position()))) {
    return fmt::format("({:.2f} m, {:.2f} m) is off the map", pose.x_m, pose.y_m);
  }
  const auto outline = with_room(model, on_lattice(map, pose), SweptCells::clearance_m(model));
  for (const RowSpan& span : covered_spans(outline, frame)) {
    if (!map.any_blocked(span.row, span.first, span.last)) continue;
    Cell cell{span.first, span.row};
    while (!map.blocked(cell)) ++cell.column;
    const geometry::Point at = frame.corner(cell);
    return map.contains(cell)
               ? fmt::format("the cell at ({:.2f} m, {:.2f} m) is blocked", at.x_m, at.y_m)
               : fmt::format("the vehicle would stand over the border of the map at ({:.2f} m, {:.2f} m)",
                             at.x_m, at.y_m);
  }
  return {};
}

void check_stands(const MissionProblem& problem, JsonComplaints& complaints) {
  check_starts(problem, complaints);
  check_locations(problem, complaints);
}

}  // namespace stepwright::fleet::internal

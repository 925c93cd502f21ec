#include "tests/support/fleet_program/planned_fleet.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "supervisor/fleet/lattice/path_planner.h"
#include "supervisor/fleet/program/driving_times.h"

namespace stepwright::fleet {
namespace {

constexpr std::chrono::milliseconds kService{1'000};
constexpr double kRoom_m = 0.15;  // to each side, that plans keep for controllers

constexpr double kRadius_m = 0.5;

VehicleModel padded(VehicleModel model) {
  model.front_m += kRoom_m;
  model.rear_m += kRoom_m;
  model.width_m += 2.0 * kRoom_m;
  // At full lock nothing is left to steer with, and the wheels slip.
  model.min_turning_radius_m += kRadius_m;
  return model;
}

// One path through all goals.
geometry::Path through(const PathPlanner& planner, const DrawnMission& mission, std::vector<Stop>& stops) {
  geometry::Path path;
  geometry::Pose from = mission.start;
  for (const geometry::Pose& goal : mission.goals) {
    const PathAnswer answer = planner.plan(from, goal, {.first_weight = 2.0, .last_weight = 2.0});
    if (!answer.path) throw std::runtime_error(result::to_string(answer.diagnostics));
    const double behind_m = path.empty() ? 0.0 : path.back().arc_m;
    for (geometry::PathPose pose : answer.path->poses) {
      if (!path.empty() && &pose == &answer.path->poses.front()) continue;
      pose.arc_m += behind_m;
      path.push_back(pose);
    }
    Stop stop;
    stop.location = "goal";
    stop.pose = path.size() - 1;
    stop.arc_m = path.back().arc_m;
    stop.service = kService;
    stops.push_back(std::move(stop));
    from = path.back().pose;
  }
  return path;
}

VehicleMission mission_of(std::size_t index, const VehicleModel& model, geometry::Path path,
                          GrownEnvelope grown, std::vector<Stop> stops) {
  VehicleMission mission;
  mission.vehicle = fmt::format("v{}", index + 1);
  mission.model = model;
  mission.path = std::move(path);
  mission.grown = std::move(grown);
  mission.stops = std::move(stops);
  return mission;
}

}  // namespace

FleetPlan plan_missions(const OccupancyGrid& grid, const std::vector<DrawnMission>& missions, Mode mode) {
  const VehicleModel model;
  const VehicleModel roomy = padded(model);
  const PrimitiveSet primitives(roomy, {});
  const HeuristicTable table = HeuristicTable::build(primitives, {.range_m = 4.0, .margin_m = 4.0});
  const auto planner = PathPlanner::create(grid, roomy, primitives, table).value();
  // A vehicle may stop: then nothing but the order of entries counts.
  const EnvelopeOptions options{.speed = {.min_mps = 0.0}};
  FleetPlan plan;
  for (std::size_t v = 0; v < missions.size(); ++v) {
    std::vector<Stop> stops;
    geometry::Path path = through(planner, missions[v], stops);
    auto grown = grow_envelope(grid, roomy.footprint(), fmt::format("v{}", v + 1), path, options);
    if (!grown) throw std::runtime_error(result::to_string(grown.error()));
    plan.missions.push_back(mission_of(v, model, std::move(path), std::move(*grown), std::move(stops)));
  }
  for (VehicleMission& mission : plan.missions) set_driving_times(mission, {});
  plan.schedule = schedule(envelopes_of(plan), plan.constraints, {.mode = mode});
  if (plan.schedule.verdict != Verdict::Scheduled) {
    throw std::runtime_error(to_string(plan.schedule.core, envelopes_of(plan), plan.constraints));
  }
  return plan;
}

FleetPlan plan_mine(std::size_t vehicles) {
  const support::DrawnFloor mine = support::draw_mine(1);
  // A permutation of the dead ends: nobody goes where somebody stays.
  constexpr std::array<std::size_t, 7> kGoals = {1, 6, 7, 0, 9, 2, 8};
  std::vector<DrawnMission> missions;
  for (std::size_t k = 0; k < vehicles; ++k) {
    geometry::Pose goal = mine.stations[kGoals[k]];
    goal.heading_rad = std::remainder(goal.heading_rad + std::numbers::pi, 2.0 * std::numbers::pi);
    missions.push_back({mine.stations[k], {goal}});
  }
  return plan_missions(mine.grid, missions);
}

FleetPlan plan_warehouse(std::size_t vehicles) {
  const support::DrawnFloor floor = support::draw_warehouse(1);
  constexpr std::array<std::array<std::size_t, 2>, 5> kTasks = {
      {{14, 0}, {21, 17}, {19, 4}, {12, 15}, {6, 5}}};
  std::vector<DrawnMission> missions;
  for (std::size_t k = 0; k < vehicles; ++k) {
    missions.push_back({floor.stations[kTasks[k][0]], {floor.stations[kTasks[k][1]]}});
  }
  return plan_missions(floor.grid, missions);
}

FleetPlan plan_alone(const geometry::Path& path) {
  double low_x = 1e9, low_y = 1e9, high_x = -1e9, high_y = -1e9;
  for (const geometry::PathPose& pose : path) {
    low_x = std::min(low_x, pose.pose.x_m - 4.0);
    low_y = std::min(low_y, pose.pose.y_m - 4.0);
    high_x = std::max(high_x, pose.pose.x_m + 4.0);
    high_y = std::max(high_y, pose.pose.y_m + 4.0);
  }
  const std::array<geometry::Point, 4> corners = {
      geometry::Point{low_x, low_y}, {high_x, low_y}, {high_x, high_y}, {low_x, high_y}};
  GrownEnvelope grown;
  grown.envelope.vehicle = "v1";
  grown.envelope.polygons.push_back({*geometry::ConvexPolygon::hull(corners), {}, {}});
  grown.visits.push_back({0, path.size() - 1, 0.0, path.back().arc_m});
  set_times(grown, {.min_mps = 0.0});
  FleetPlan plan;
  plan.missions.push_back(mission_of(0, {}, path, std::move(grown), {}));
  plan.schedule = schedule(envelopes_of(plan), {}, {.mode = Mode::Strict});
  return plan;
}

}  // namespace stepwright::fleet

#include "tests/unit/supervisor/fleet/mission/small_floor.h"

#include <gtest/gtest.h>

#include "tests/support/fleet/exact_outline.h"
#include "tests/support/fleet/schedule_checker.h"

namespace stepwright::fleet {

MissionProblem empty_problem() {
  MissionProblem problem;
  problem.file = "test.json";
  problem.map = OccupancyGrid({.resolution_m = 0.2, .origin = {0, 0}, .columns = 200, .rows = 120});
  problem.classes.push_back({.name = "forklift", .model = {}, .key = "models[0]"});
  return problem;
}

void wall(MissionProblem& problem, double x0, double y0, double x1, double y1) {
  const auto& frame = problem.map.frame();
  const Cell low = frame.cell_at({x0 + 1e-6, y0 + 1e-6});
  const Cell high = frame.cell_at({x1 - 1e-6, y1 - 1e-6});
  for (int row = low.row; row <= high.row; ++row) {
    for (int column = low.column; column <= high.column; ++column) problem.map.set({column, row}, true);
  }
}

std::size_t add_vehicle(MissionProblem& problem, const std::string& name, const geometry::Pose& start) {
  MissionVehicle vehicle;
  vehicle.name = name;
  vehicle.start = start;
  vehicle.key = "vehicles[" + std::to_string(problem.vehicles.size()) + "]";
  problem.vehicles.push_back(std::move(vehicle));
  return problem.vehicles.size() - 1;
}

std::size_t add_location(MissionProblem& problem, const std::string& name, const geometry::Pose& pose,
                         std::chrono::milliseconds service) {
  problem.locations.push_back({.name = name, .pose = pose, .service = service, .key = "locations"});
  return problem.locations.size() - 1;
}

void add_task(MissionProblem& problem, std::size_t vehicle, std::size_t location) {
  problem.tasks.push_back({.name = "task " + std::to_string(problem.tasks.size() + 1),
                           .vehicle = vehicle,
                           .location = location,
                           .key = "tasks[" + std::to_string(problem.tasks.size()) + "]"});
}

FleetFloor floor_of(const MissionProblem& problem) {
  return FleetFloor::create(problem.map, models_of(problem),
                            {.table_folder = {}, .table_range_m = 3.0, .table_margin_m = 3.0})
      .value();
}

FleetAnswer planned(const MissionProblem& problem, const FleetOptions& options) {
  FleetFloor floor = floor_of(problem);
  auto answer = plan_fleet(problem, floor, options);
  if (!answer) {
    ADD_FAILURE() << to_string(answer.error());
    return {};
  }
  return *std::move(answer);
}

void expect_sound(const MissionProblem& problem, const FleetPlan& plan, Mode mode) {
  const auto envelopes = envelopes_of(plan);
  ASSERT_EQ(plan.schedule.earliest.size(), envelopes.size());
  const auto expect_times = [&](const std::vector<VehicleTimes>& times) {
    for (const std::string& fault : faults_of(times, envelopes, plan.constraints, mode))
      ADD_FAILURE() << fault;
  };
  // Every pair of polygons is looked at each time, so that large plans are judged once.
  std::size_t polygons = 0;
  for (const TrajectoryEnvelope& envelope : envelopes) polygons += envelope.polygons.size();
  expect_times(plan.schedule.earliest);
  if (mode == Mode::Strict && polygons < 200) {
    expect_times(plan.schedule.latest);
    expect_times(random_times(plan.schedule, envelopes, plan.constraints, 1));
  }
  for (const VehicleMission& mission : plan.missions) {
    geometry::Path looked_at;
    for (std::size_t k = 0; k < mission.path.size(); k += 5) looked_at.push_back(mission.path[k]);
    EXPECT_FALSE(support::first_hit(problem.map, mission.model.footprint(), looked_at)) << mission.vehicle;
    for (const Stop& stop : mission.stops)
      EXPECT_EQ(mission.path[stop.pose].arc_m, stop.arc_m) << stop.location;
  }
}

}  // namespace stepwright::fleet

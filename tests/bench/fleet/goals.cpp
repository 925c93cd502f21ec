#include "tests/bench/fleet/goals.h"

#include <time.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "supervisor/fleet/mission/add_mission.h"
#include "supervisor/fleet/mission/plan_fleet.h"
#include "supervisor/fleet/schedule/retiming.h"
#include "tests/support/fleet/floor_maps.h"
#include "tests/support/fleet/schedule_checker.h"

namespace stepwright::bench::fleet {

namespace {

using namespace stepwright::fleet;

constexpr std::size_t kVehicles = 7;

double now_ms(const Settings& settings) {
  timespec time{};
  clock_gettime(settings.cpu_time ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

// A floor with tasks for seven vehicles, and places where nobody's way ends.
struct Site {
  support::DrawnFloor floor;
  std::vector<support::DrawnTask> tasks;
  std::vector<geometry::Pose> free;
};

// As the goals of the tasks: forwards into a dead end.
geometry::Pose inwards(geometry::Pose station) {
  station.heading_rad += std::numbers::pi;
  return station;
}

Site mine(std::uint64_t seed) {
  Site site{support::draw_mine(seed), {}, {}};
  site.tasks = support::mine_tasks(site.floor);
  for (const std::size_t k : {0U, 2U, 5U}) site.free.push_back(inwards(site.floor.stations[k]));
  return site;
}

Site warehouse_site(std::uint64_t seed) {
  Site site{support::draw_warehouse(seed), {}, {}};
  const auto& stations = site.floor.stations;
  for (std::size_t k = 0; k < kVehicles; ++k)
    site.tasks.push_back({stations[k], stations[stations.size() - 1 - k]});
  for (std::size_t k = 0; k < 3; ++k) site.free.push_back(stations[kVehicles + 1 + k]);
  return site;
}

MissionProblem problem_of(const Site& site) {
  MissionProblem problem;
  problem.map = site.floor.grid;
  problem.classes.push_back({.name = "loader", .model = {}, .key = {}});
  for (std::size_t k = 0; k < kVehicles; ++k) {
    const std::string number = std::to_string(k + 1);
    MissionVehicle vehicle;
    vehicle.name = "loader " + number;
    vehicle.start = site.tasks[k].start;
    problem.vehicles.push_back(vehicle);
    problem.locations.push_back({.name = "goal " + number, .pose = site.tasks[k].goal, .key = {}});
    problem.tasks.push_back({.name = number, .vehicle = k, .location = k, .key = {}});
  }
  return problem;
}

FleetFloor floor_of(const MissionProblem& problem, const Settings& settings) {
  const FloorOptions options{.table_folder = std::filesystem::path(settings.folder) / "tables"};
  return FleetFloor::create(problem.map, models_of(problem), options).value();
}

void add_goals(const Site& site, const MissionProblem& problem, const FleetPlan& plan, bool known,
               const Settings& settings, GoalsRow& row) {
  const RunningPlan running{
      .now = std::chrono::seconds(30),
      .times = Retiming(envelopes_of(plan), plan.constraints, plan.schedule).earliest()};
  GoalTimes& times = known ? row.known : row.cold;
  for (std::uint32_t v = 0; v < plan.missions.size(); ++v) {
    FleetFloor floor = floor_of(problem, settings);
    const std::array<geometry::Pose, 2> at = {site.free[v % 3], site.free[(v + 1) % 3]};
    const double prepare_ms = now_ms(settings);
    if (known) floor.prepare_goals(0, at);
    const double begin_ms = now_ms(settings);
    if (known) row.prepare_ms += (begin_ms - prepare_ms) / 2.0;
    const NewMission mission{.stops = {{StopKind::PickUp, "from", at[0], std::chrono::seconds(10), "new", 1},
                                       {StopKind::SetDown, "to", at[1], std::chrono::seconds(10), "new", 1}},
                             .vehicles = {v}};
    const AddedMission added = add_mission(floor, plan, running, mission, {.time = kWholeTime});
    times.total_ms.push_back(now_ms(settings) - begin_ms);
    times.paths_ms.push_back(added.paths_ms);
    if (added.verdict != Verdict::Scheduled) continue;
    ++times.scheduled;
    const auto faults = faults_of(added.plan.schedule.earliest, envelopes_of(added.plan),
                                  added.plan.constraints, Mode::Strict);
    times.faults += faults.empty() ? 0 : 1;
  }
}

double at(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values.empty()
             ? 0.0
             : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

}  // namespace

double GoalTimes::total(double share) const {
  return at(total_ms, share);
}

GoalsRow measure_goals(std::uint32_t instances, const Settings& settings) {
  GoalsRow row;
  for (std::uint32_t k = 0; k < 2 * instances; ++k) {
    const Site site = k % 2 == 0 ? mine(1 + k / 2) : warehouse_site(1 + k / 2);
    const MissionProblem problem = problem_of(site);
    FleetFloor floor = floor_of(problem, settings);
    const auto answer =
        plan_fleet(problem, floor, {.objective = Objective::None, .time = kWholeTime, .path_factor = 1.2});
    if (!answer || answer->verdict != Verdict::Scheduled) continue;
    ++row.floors;
    for (const bool known : {false, true}) add_goals(site, problem, answer->plan, known, settings, row);
  }
  if (!row.known.total_ms.empty()) row.prepare_ms /= static_cast<double>(row.known.total_ms.size());
  return row;
}

void print(const GoalsRow& row) {
  std::printf("one more goal while a plan runs, %u mines and warehouses\n", row.floors);
  const auto line = [](const char* name, const GoalTimes& times) {
    std::printf(
        "   %-22s median %6.1f ms, worst %6.1f (paths: median %5.1f, worst %5.1f); %u of %zu scheduled\n",
        name, times.total(0.5), times.total(1.0), at(times.paths_ms, 0.5), at(times.paths_ms, 1.0),
        times.scheduled, times.total_ms.size());
  };
  line("floor without a path", row.cold);
  line("costs of ways known", row.known);
  std::printf("   costs of ways to a station, before: %.0f ms\n", row.prepare_ms);
}

}  // namespace stepwright::bench::fleet

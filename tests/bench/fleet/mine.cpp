#include "tests/bench/fleet/mine.h"

#include <time.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "supervisor/fleet/mission/plan_fleet.h"
#include "tests/bench/fleet/esta.h"
#include "tests/support/fleet/floor_maps.h"
#include "tests/support/fleet/schedule_checker.h"

namespace stepwright::bench::fleet {

namespace {

using namespace stepwright::fleet;
using WallClock = std::chrono::steady_clock;

constexpr int kRounds = 5;
constexpr double kPathFactor = 1.2;  // paths are proved to cost at most so many times the least

double since_ms(WallClock::time_point begin) {
  return std::chrono::duration<double, std::milli>(WallClock::now() - begin).count();
}

// Wall time, or CPU time of all threads together, on a machine that is busy.
double now_ms(const Settings& settings) {
  timespec time{};
  clock_gettime(settings.cpu_time ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? 0.0 : values[values.size() / 2];
}

MissionProblem mine_problem(const support::DrawnFloor& mine) {
  MissionProblem problem;
  problem.map = mine.grid;
  problem.classes.push_back({.name = "loader", .model = {}, .key = {}});
  for (const support::DrawnTask& task : support::mine_tasks(mine)) {
    const std::string number = std::to_string(problem.vehicles.size() + 1);
    MissionVehicle vehicle;
    vehicle.name = "loader " + number;
    vehicle.start = task.start;
    problem.vehicles.push_back(vehicle);
    problem.locations.push_back({.name = "goal " + number, .pose = task.goal, .key = {}});
    problem.tasks.push_back({.name = number,
                             .vehicle = problem.vehicles.size() - 1,
                             .location = problem.locations.size() - 1,
                             .key = {}});
  }
  return problem;
}

FleetFloor floor_of(const MissionProblem& problem, const Settings& settings) {
  const FloorOptions options{.table_folder = std::filesystem::path(settings.folder) / "tables"};
  return FleetFloor::create(problem.map, models_of(problem), options).value();
}

FleetAnswer chain(const MissionProblem& problem, const Settings& settings, double path_factor,
                  double& prepare_ms, double& total_ms) {
  const double begin_ms = now_ms(settings);
  FleetFloor floor = floor_of(problem, settings);
  prepare_ms = now_ms(settings) - begin_ms;
  auto answer = plan_fleet(problem, floor,
                           {.objective = Objective::None, .time = kWholeTime, .path_factor = path_factor});
  total_ms = now_ms(settings) - begin_ms;
  return answer ? *std::move(answer) : FleetAnswer{};
}

void measure_chain(const MissionProblem& problem, const Settings& settings, MineRow& row) {
  floor_of(problem, settings);  // stores the table
  std::vector<double> total, prepare, paths, envelopes, scheduling, repair;
  FleetPlan plan;
  for (int round = 0; round < kRounds; ++round) {
    double prepare_ms = 0.0;
    double total_ms = 0.0;
    FleetAnswer answer = chain(problem, settings, kPathFactor, prepare_ms, total_ms);
    total.push_back(total_ms);
    prepare.push_back(prepare_ms);
    paths.push_back(answer.figures.paths_ms);
    envelopes.push_back(answer.figures.envelopes_ms);
    scheduling.push_back(answer.figures.schedule_ms);
    repair.push_back(answer.figures.repair_ms);
    row.scheduled = answer.verdict == Verdict::Scheduled;
    plan = std::move(answer.plan);
  }
  row.total_ms = median(total);
  row.prepare_ms = median(prepare);
  row.paths_ms = median(paths);
  row.envelopes_ms = median(envelopes);
  row.schedule_ms = median(scheduling);
  row.repair_ms = median(repair);
  double prepare_ms = 0.0;
  chain(problem, settings, 1.0, prepare_ms, row.best_paths_ms);
  const auto made = envelopes_of(plan);
  for (const TrajectoryEnvelope& envelope : made) row.polygons += envelope.polygons.size();
  if (!row.scheduled) return;
  for (const auto& times : {plan.schedule.earliest, plan.schedule.latest}) {
    if (!faults_of(times, made, plan.constraints, Mode::Strict).empty()) ++row.faults;
  }
}

void measure_baseline(const MissionProblem& problem, const Settings& settings, MineRow& row) {
  const FleetFloor floor = floor_of(problem, settings);
  const double begin_ms = now_ms(settings);
  const auto begin = WallClock::now();
  std::vector<PathAnswer> paths(problem.tasks.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t k = next++; k < paths.size(); k = next++) {
      paths[k] = floor.planner(0).plan(problem.vehicles[k].start, problem.locations[k].pose,
                                       {.heuristic = Heuristic::Euclid});
    }
  };
  {
    const std::jthread helper(work);
    work();
  }
  row.baseline_paths_ms = since_ms(begin);
  Instance instance;
  const auto planned = WallClock::now();
  for (std::size_t k = 0; k < paths.size(); ++k) {
    EnvelopeOptions options;
    options.speed = problem.vehicles[k].speed;
    auto grown = grow_envelope(problem.map, VehicleModel{}.footprint(), problem.vehicles[k].name,
                               paths[k].path.value().poses, options);
    instance.envelopes.push_back(std::move(grown.value().envelope));
  }
  row.baseline_envelopes_ms = since_ms(planned);
  const auto grown = WallClock::now();
  row.baseline_timeout =
      solve_esta(instance, Closure::Incremental, {CLOCK_MONOTONIC, settings.cap_s}).found == Found::TimeOut;
  row.baseline_schedule_ms = since_ms(grown);
  row.baseline_ms = now_ms(settings) - begin_ms + row.prepare_ms;
}

}  // namespace

MineRow measure_mine(const Settings& settings) {
  const support::DrawnFloor mine = support::draw_mine(1);
  const MissionProblem problem = mine_problem(mine);
  MineRow row;
  measure_chain(problem, settings, row);
  measure_baseline(problem, settings, row);
  return row;
}

void print(const MineRow& row) {
  std::printf(
      "mine of 120 x 80 m, seven vehicles, from goals to scheduled envelopes, strict mode, %zu polygons\n",
      row.polygons);
  std::printf(
      "   stepwright    %8.1f ms: models %.1f, paths %.1f, envelopes %.1f, schedule %.1f, other paths "
      "%.1f%s\n",
      row.total_ms, row.prepare_ms, row.paths_ms, row.envelopes_ms, row.schedule_ms, row.repair_ms,
      row.scheduled ? "" : "; NO SCHEDULE");
  std::printf("   best paths    %8.1f ms\n", row.best_paths_ms);
  std::printf("   baseline      %8.1f ms: models %.1f, paths %.1f, envelopes %.1f, paper-fair %.1f%s\n",
              row.baseline_ms, row.prepare_ms, row.baseline_paths_ms, row.baseline_envelopes_ms,
              row.baseline_schedule_ms, row.baseline_timeout ? " (cap)" : "");
}

}  // namespace stepwright::bench::fleet

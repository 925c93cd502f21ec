// Paths and envelopes of the fleet, with simpler searches beside them in the same process: preparation, a way
// of 75 m through a warehouse, seven vehicles in a mine, the 900 circle problems.
//
//   bench_lattice [--json FILE] [--runs N]        N of the 100 runs of each circle problem; default 100

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>
#include <vector>

#include "runtime/ground/result/exit_code.h"
#include "tests/bench/lattice/circle_envelopes.h"
#include "tests/bench/lattice/plain_search.h"
#include "tests/support/fleet/floor_maps.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::bench {
namespace {

using namespace fleet;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

constexpr int kRepeats = 3;

// The best of several runs, in milliseconds: the others were disturbed.
template <typename Run>
double best_ms(Run run) {
  double best = 1e300;
  for (int k = 0; k < kRepeats; ++k) {
    const auto start = Clock::now();
    run();
    best = std::min(best, std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  return best;
}

struct Bench {
  VehicleModel vehicle;
  PrimitiveSet primitives{vehicle, {}};
  HeuristicTable table = HeuristicTable::build(primitives);
  Json json;

  void say(const char* key, const char* text, double value) {
    std::printf("  %-70s %10.2f\n", text, value);
    json[key] = value;
  }
};

void measure_preparation(Bench& bench) {
  std::puts("preparation, once for a vehicle");
  bench.say("primitives_ms", "primitives, ms", best_ms([&] { PrimitiveSet(bench.vehicle, {}); }));
  bench.say("swept_cells_ms", "swept cells, ms",
            best_ms([&] { SweptCells(bench.vehicle, bench.primitives, 1); }));
  bench.say("table_build_ms", "look-up table of 10 m, ms",
            best_ms([&] { HeuristicTable::build(bench.primitives); }));
  const support::TemporaryFolder folder;
  const auto file = folder / "vehicle.table";
  HeuristicTable::load_or_build(bench.primitives, {}, file);
  bench.say("table_load_ms", "the same from its file, ms",
            best_ms([&] { HeuristicTable::load_or_build(bench.primitives, {}, file); }));
}

void measure_search(Bench& bench, const PathPlanner& planner, const support::DrawnTask& task,
                    const std::string& key, const char* text, const PathOptions& options) {
  PathAnswer answer;
  const double ms = best_ms([&] { answer = planner.plan(task.start, task.goal, options); });
  bench.say((key + "_ms").c_str(), (std::string(text) + ", ms").c_str(), ms);
  bench.say((key + "_expanded").c_str(), "  expanded", static_cast<double>(answer.expanded));
  bench.say((key + "_cost_m").c_str(), "  cost, m", answer.path.value().cost_mm / 1000.0);
  bench.say((key + "_epsilon").c_str(), "  proved within a factor of", answer.epsilon);
}

void measure_aisles(Bench& bench) {
  const support::DrawnFloor floor = support::draw_warehouse(1);
  const auto planner = PathPlanner::create(floor.grid, bench.vehicle, bench.primitives, bench.table).value();
  const support::DrawnTask task{floor.stations.front(), floor.stations.back()};
  std::puts("75 m through a warehouse of 80 x 60 m");
  measure_search(bench, planner, task, "aisles_first", "ARA*, weight 3",
                 {.first_weight = 3.0, .last_weight = 3.0});
  measure_search(bench, planner, task, "aisles_near", "ARA*, weights 3 to 1.5",
                 {.first_weight = 3.0, .last_weight = 1.5});
  measure_search(bench, planner, task, "aisles_best", "A*", {});
  measure_search(bench, planner, task, "aisles_euclid", "baseline: A* with Euclidean distance only",
                 {.heuristic = Heuristic::Euclid});
  PlainResult plain;
  const auto begin = Clock::now();
  plain = plain_search(floor.grid, bench.vehicle, bench.primitives, task.start, task.goal);
  const double plain_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  bench.say("aisles_plain_ms", "baseline: A* with hash map, outlines and distances, ms", plain_ms);
  bench.say("aisles_plain_expanded", "  expanded", static_cast<double>(plain.expanded));
  bench.say("aisles_plain_cost_m", "  cost, m", plain.cost_mm / 1000.0);
  bench.say("aisles_ratio_plain", "ratio of this baseline to A*",
            plain_ms / bench.json["aisles_best_ms"].get<double>());
}

void measure_mine(Bench& bench) {
  const support::DrawnFloor mine = support::draw_mine(1);
  const auto tasks = support::mine_tasks(mine);
  std::puts("seven vehicles in a mine of 120 x 80 m, two threads");
  const double map_ms =
      best_ms([&] { PathPlanner::create(mine.grid, bench.vehicle, bench.primitives, bench.table).value(); });
  bench.say("mine_planner_ms", "planner for the map (swept cells, distances), ms", map_ms);
  const auto planner = PathPlanner::create(mine.grid, bench.vehicle, bench.primitives, bench.table).value();
  std::vector<PathAnswer> answers(tasks.size());
  std::vector<GrownEnvelope> envelopes(tasks.size());
  const auto on_two_threads = [&](const auto& job) {
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
      for (std::size_t k = next++; k < tasks.size(); k = next++) job(k);
    };
    const std::jthread helper(work);
    work();
  };
  const double paths_ms = best_ms([&] {
    on_two_threads([&](std::size_t k) {
      answers[k] = planner.plan(tasks[k].start, tasks[k].goal, {.first_weight = 2.0, .last_weight = 2.0});
    });
  });
  const double growth_ms = best_ms([&] {
    on_two_threads([&](std::size_t k) {
      envelopes[k] =
          grow_envelope(mine.grid, bench.vehicle.footprint(), "", answers[k].path.value().poses, {}).value();
    });
  });
  double length_m = 0.0;
  double worst = 1.0;
  double expanded = 0.0;
  std::size_t polygons = 0;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    length_m += answers[k].path->length_m;
    worst = std::max(worst, answers[k].epsilon);
    expanded += static_cast<double>(answers[k].expanded);
    polygons += envelopes[k].visits.size();
  }
  bench.say("mine_paths_ms", "all paths, ARA*, weight 2, ms", paths_ms);
  bench.say("mine_expanded", "  expanded", expanded);
  bench.say("mine_length_m", "  length of all, m", length_m);
  bench.say("mine_worst_epsilon", "  each proved within a factor of", worst);
  bench.say("mine_envelopes_ms", "all envelopes, ms", growth_ms);
  bench.say("mine_polygons", "  polygons", static_cast<double>(polygons));
}

void measure_circle(Bench& bench, int runs) {
  std::puts("the circle problems");
  HeuristicTable table = bench.table;
  bench.say("circle_table_ms", "look-up table of 41 m, two threads, ms", best_ms([&] {
              table = HeuristicTable::build(bench.primitives, {.range_m = 41.0, .threads = 2});
            }));
  CircleEnvelopes circle(bench.vehicle, bench.primitives, table, {});
  std::size_t most = 0;
  int overlapping_starts = 0;
  for (int vehicles = 2; vehicles <= 10; ++vehicles) {
    std::size_t polygons = 0;
    for (int run = 0; run < runs; ++run) {
      std::size_t of_run = 0;
      std::vector<const GrownEnvelope*> grown;
      for (const auto& task : support::circle_problem(vehicles, run)) {
        grown.push_back(&circle.of(task));
        of_run += grown.back()->visits.size();
        for (std::size_t k = 0; k + 1 < grown.size(); ++k) {
          const auto& a = grown[k]->envelope.polygons.front().area;
          overlapping_starts += overlaps(a, grown.back()->envelope.polygons.front().area) ? 1 : 0;
        }
      }
      polygons += of_run;
      most = std::max(most, of_run);
    }
    const std::string key = "circle_polygons_per_vehicle_n" + std::to_string(vehicles);
    const std::string text = "polygons per vehicle, " + std::to_string(vehicles) + " vehicles";
    bench.say(key.c_str(), text.c_str(), static_cast<double>(polygons) / (runs * vehicles));
  }
  const auto planned = static_cast<double>(circle.planned());
  bench.say("circle_most_polygons", "most polygons of a problem", static_cast<double>(most));
  bench.say("circle_overlapping_starts", "pairs of first polygons that overlap", overlapping_starts);
  bench.say("circle_paths", "different paths", planned);
  bench.say("circle_path_length_m", "  mean length, m", circle.length_m() / planned);
  bench.say("circle_path_ms", "  mean time of A*, ms", circle.path_ms() / planned);
  bench.say("circle_path_expanded", "  mean expanded", static_cast<double>(circle.expanded()) / planned);
  bench.say("circle_envelope_ms", "  mean time of an envelope, ms", circle.growth_ms() / planned);
}

// One file for each problem and speed, so that every solver gets the same input.
int run(const char* json_file, int runs) {
  Bench bench;
  measure_preparation(bench);
  measure_aisles(bench);
  measure_mine(bench);
  measure_circle(bench, runs);
  if (json_file == nullptr) return result::to_int(result::ExitCode::Done);
  std::ofstream file(json_file);
  file << bench.json.dump(2) << "\n";
  return result::to_int(file ? result::ExitCode::Done : result::ExitCode::BadInput);
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  const char* json_file = nullptr;
  int runs = stepwright::support::kCircleRuns;
  for (int k = 1; k < argc; k += 2) {
    const auto is = [&](const char* option) { return k + 1 < argc && std::strcmp(argv[k], option) == 0; };
    if (is("--json")) json_file = argv[k + 1];
    if (is("--runs")) runs = std::atoi(argv[k + 1]);
    const bool known = is("--json") || is("--runs");
    if (!known || runs < 1 || runs > stepwright::support::kCircleRuns) {
      std::fprintf(stderr, "usage: bench_lattice [--json FILE] [--runs 1..100]\n");
      return stepwright::result::to_int(stepwright::result::ExitCode::Usage);
    }
  }
  return stepwright::bench::run(json_file, runs);
}

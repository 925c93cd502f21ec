// The scheduler of the fleet beside the paper's (Pecora and Cirillo 2012) as baselines and z3 as referee, and
// the whole chain in a mine.
//
//   bench_fleet [--full] [--runs N] [--least N] [--most N] [--v-max MPS] [--cap S] [--scale N] [--no-literal]
//               [--literal-runs N] [--keep FILE [--kept-only]] [--no-referee] [--cpu-time] [--write FOLDER]
//               [--json FILE]
//               [--svg FILE]
//
// Wall times (or CPU times, on a busy machine) of one thread, from envelopes to verdict; an instance that a
// baseline does not finish counts as the cap. A few runs without --full, which takes 100 runs for each number
// of vehicles, warehouses of up to 1000 vehicles and a cap of 60 s.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"
#include "supervisor/fleet/schedule/problem_file.h"
#include "tests/bench/fleet/figure.h"
#include "tests/bench/fleet/goals.h"
#include "tests/bench/fleet/measure.h"
#include "tests/bench/fleet/mine.h"

namespace stepwright::bench::fleet {
namespace {

constexpr std::uint32_t kFloors = 4;  // mines, and as many warehouses, for new goals

struct Arguments {
  Settings settings;
  bool full = false;
  bool no_literal = false;
  bool no_referee = false;
  std::string write_folder;
  std::string json_file;
  std::string svg_file;
  std::string kept_file;
};

// All instances as files, so that every other solver gets the same.
bool write_instances(const Arguments& arguments) {
  CircleSource source;
  bool written = true;
  for (std::uint32_t n = arguments.settings.least; n <= arguments.settings.most; ++n) {
    for (std::uint32_t r = 0; r < arguments.settings.runs; ++r) {
      const Instance instance = source.instance(n, r, arguments.settings.v_max_mps);
      const std::string name = "circle_" + std::to_string(n) + "_" + std::to_string(r) + ".json";
      std::ofstream out(std::filesystem::path(arguments.write_folder) / name);
      out << stepwright::fleet::write_problem({instance.envelopes, instance.constraints});
      written = written && out.good();
    }
  }
  return written;
}

void print_solver(const char* name, const Times& times) {
  if (times.ms.empty()) return;
  std::printf("   %-13s %4zu %10.3f %10.3f %10.3f %10.3f %10.3f %8u %10llu\n", name, times.ms.size(),
              times.mean(), times.quantile(0.5), times.quantile(0.95), times.quantile(0.99),
              times.quantile(1.0), times.timeouts, static_cast<unsigned long long>(times.nodes));
}

void print(const CircleRow& row) {
  std::printf(
      "%2u vehicles: %u schedules (strict mode: %u), %u without, at most %zu polygons, %zu conflicts at the "
      "root\n",
      row.vehicles, row.scheduled, row.strictly_scheduled, row.infeasible, row.most_polygons, row.conflicts);
  print_solver("stepwright", row.ours);
  print_solver("paper-fair", row.fair);
  print_solver("paper-literal", row.literal);
  if (row.disagreements + row.baseline_disagreements + row.faults + row.unjudged > 0) {
    std::printf("   DISAGREEMENTS: referee %u, baselines %u, checker %u; not judged %u\n", row.disagreements,
                row.baseline_disagreements, row.faults, row.unjudged);
  }
  std::fflush(stdout);
}

nlohmann::json to_json(const Times& times) {
  return {{"runs", times.ms.size()},          {"mean_ms", times.mean()},
          {"median_ms", times.quantile(0.5)}, {"p95_ms", times.quantile(0.95)},
          {"p99_ms", times.quantile(0.99)},   {"max_ms", times.quantile(1.0)},
          {"timeouts", times.timeouts},       {"nodes", times.nodes}};
}

nlohmann::json to_json(const CircleRow& row) {
  nlohmann::json json = {{"vehicles", row.vehicles},           {"scheduled", row.scheduled},
                         {"infeasible", row.infeasible},       {"strictly_scheduled", row.strictly_scheduled},
                         {"most_polygons", row.most_polygons}, {"conflicts", row.conflicts},
                         {"stepwright", to_json(row.ours)},    {"paper_fair", to_json(row.fair)}};
  if (!row.literal.ms.empty()) json["paper_literal"] = to_json(row.literal);
  return json;
}

struct Totals {
  Times ours;
  std::uint32_t referee = 0, baselines = 0, faults = 0, unjudged = 0;
};

bool circles(const Arguments& arguments, nlohmann::json& json, Totals& totals) {
  std::printf("circle of 40 m, v_max %.2f m/s, %u runs each; baselines stop after %.0f s\n",
              arguments.settings.v_max_mps, arguments.settings.runs, arguments.settings.cap_s);
  std::printf("   %-13s %4s %10s %10s %10s %10s %10s %8s %10s\n", "ms", "runs", "mean", "median", "p95",
              "p99", "max", "timeouts", "nodes");
  CircleSource source;
  std::vector<CircleRow> rows;
  for (std::uint32_t n = arguments.settings.least; n <= arguments.settings.most; ++n) {
    std::string error;
    rows.push_back(measure_circle(source, n, arguments.settings, error));
    const CircleRow& row = rows.back();
    print(row);
    if (!error.empty()) {
      std::fprintf(stderr, "bench_fleet: %s\n", error.c_str());
      return false;
    }
    json["circles"].push_back(to_json(row));
    totals.ours.ms.insert(totals.ours.ms.end(), row.ours.ms.begin(), row.ours.ms.end());
    totals.referee += row.disagreements;
    totals.baselines += row.baseline_disagreements;
    totals.faults += row.faults;
    totals.unjudged += row.unjudged;
    if (n == 8 || n == 10) {
      const double ratio = row.fair.mean() / row.ours.mean();
      json["ratio_to_paper_fair_n" + std::to_string(n)] = ratio;
      std::printf("   paper-fair / stepwright: %.0f\n", ratio);
    }
  }
  if (!arguments.svg_file.empty()) std::ofstream(arguments.svg_file) << figure_4(rows);
  return true;
}

void warehouses(const Arguments& arguments, nlohmann::json& json, Totals& totals) {
  std::printf(
      "warehouse, vehicles that may stop, strict mode\n%9s %9s %9s %9s %9s %9s %9s %9s %9s "
      "%9s\n",
      "vehicles", "polygons", "pairs", "sections", "total ms", "geometry", "search", "conflicts", "retime",
      "worst");
  for (const std::uint32_t n : {20U, 50U, 100U, 200U, 500U, 1000U}) {
    if (n > arguments.settings.scale) break;
    const WarehouseRow row = measure_warehouse(n, arguments.settings);
    std::printf("%9u %9zu %9zu %9zu %9.2f %9.2f %9.2f %9llu %9.4f %9.4f %s\n", row.vehicles, row.polygons,
                row.pairs, row.sections, row.schedule_ms, row.geometry_ms, row.search_ms,
                static_cast<unsigned long long>(row.conflicts), row.retime_ms, row.retime_worst_ms,
                row.scheduled ? "" : "no schedule");
    std::fflush(stdout);
    totals.faults += row.faults;
    json["warehouses"].push_back({{"vehicles", n},
                                  {"polygons", row.polygons},
                                  {"spatial_pairs", row.pairs},
                                  {"sections", row.sections},
                                  {"scheduled", row.scheduled},
                                  {"schedule_ms", row.schedule_ms},
                                  {"retime_ms", row.retime_ms},
                                  {"retime_worst_ms", row.retime_worst_ms}});
    if (n == 100 || n == 1000) json["vehicles_" + std::to_string(n) + "_ms"] = row.schedule_ms;
    if (n == 1000 && row.scheduled) json["retime_1000_ms"] = row.retime_ms;
  }
}

void mine(const Arguments& arguments, nlohmann::json& json, Totals& totals) {
  const MineRow row = measure_mine(arguments.settings);
  print(row);
  totals.faults += row.faults;
  json["mine_total_ms"] = row.total_ms;
  json["mine_prepare_ms"] = row.prepare_ms;
  json["mine_paths_ms"] = row.paths_ms;
  json["mine_envelopes_ms"] = row.envelopes_ms;
  json["mine_schedule_ms"] = row.schedule_ms;
  json["mine_repair_ms"] = row.repair_ms;
  json["mine_best_paths_total_ms"] = row.best_paths_ms;
  json["mine_polygons"] = row.polygons;
  json["mine_scheduled"] = row.scheduled;
  json["mine_baseline_ms"] = row.baseline_ms;
  json["mine_baseline_paths_ms"] = row.baseline_paths_ms;
  json["mine_baseline_schedule_ms"] = row.baseline_schedule_ms;
  json["mine_baseline_timeout"] = row.baseline_timeout;
}

void goals(const Arguments& arguments, nlohmann::json& json, Totals& totals) {
  const GoalsRow row = measure_goals(arguments.full ? kFloors : 1, arguments.settings);
  print(row);
  totals.faults += row.cold.faults + row.known.faults;
  json["new_goal_ms"] = row.known.total(0.5);
  json["new_goal_worst_ms"] = row.known.total(1.0);
  json["new_goal_prepare_ms"] = row.prepare_ms;
  json["new_goal_cold_ms"] = row.cold.total(0.5);
  json["new_goal_cold_worst_ms"] = row.cold.total(1.0);
  json["new_goals"] = row.known.total_ms.size();
  json["new_goals_scheduled"] = row.known.scheduled;
  json["new_goals_cold_scheduled"] = row.cold.scheduled;
}

int run(const Arguments& arguments) {
  nlohmann::json json;
  Totals totals;
  if (!circles(arguments, json, totals)) return to_int(result::ExitCode::RuntimeFault);
  warehouses(arguments, json, totals);
  mine(arguments, json, totals);
  goals(arguments, json, totals);
  json["instances"] = totals.ours.ms.size();
  json["mean_ms"] = totals.ours.mean();
  json["p99_ms"] = totals.ours.quantile(0.99);
  if (arguments.settings.referee) json["referee_disagreements"] = totals.referee;
  json["referee_gave_up"] = totals.unjudged;
  json["baseline_disagreements"] = totals.baselines;
  json["checker_faults"] = totals.faults;
  std::printf(
      "%zu circles (%s): mean %.3f ms, p99 %.3f ms; disagreements: referee %u, baselines %u, checker %u\n",
      totals.ours.ms.size(), arguments.settings.cpu_time ? "CPU time" : "wall time", totals.ours.mean(),
      totals.ours.quantile(0.99), totals.referee, totals.baselines, totals.faults);
  if (!arguments.json_file.empty()) std::ofstream(arguments.json_file) << json.dump(2) << "\n";
  const bool sound = totals.referee + totals.baselines + totals.faults == 0;
  return to_int(sound ? result::ExitCode::Done : result::ExitCode::RuntimeFault);
}

}  // namespace
}  // namespace stepwright::bench::fleet

int main(int argc, char** argv) {
  using namespace stepwright::bench::fleet;
  Arguments arguments;
  Settings& settings = arguments.settings;
  CLI::App app("the scheduler of the fleet beside its baselines and its referee", "bench_fleet");
  app.add_flag("--full", arguments.full, "100 runs, warehouses up to 1000 vehicles, a cap of 60 s");
  auto* runs = app.add_option("--runs", settings.runs)->check(CLI::Range(1, 10000));
  app.add_option("--least", settings.least)->check(CLI::Range(2, 10));
  app.add_option("--most", settings.most)->check(CLI::Range(2, 10));
  app.add_option("--v-max", settings.v_max_mps)->check(CLI::Range(0.1, 100.0));
  auto* cap = app.add_option("--cap", settings.cap_s)->check(CLI::Range(0.01, 3600.0));
  auto* scale = app.add_option("--scale", settings.scale);
  app.add_flag("--no-literal", arguments.no_literal);
  app.add_option("--literal-runs", settings.literal_runs, "runs that paper-literal takes part in, at most");
  auto* keep = app.add_option("--keep", arguments.kept_file,
                              "what paper-literal took: read, and what is new appended");
  app.add_flag("--kept-only", settings.kept_only, "of paper-literal what is kept, nothing new")->needs(keep);
  app.add_flag("--no-referee", arguments.no_referee);
  app.add_flag("--cpu-time", settings.cpu_time, "CPU time of the thread instead of wall time");
  app.add_option("--write", arguments.write_folder,
                 "write the circles as files to this folder, measure nothing");
  app.add_option("--json", arguments.json_file);
  app.add_option("--svg", arguments.svg_file);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : to_int(stepwright::result::ExitCode::Usage);
  }
  if (arguments.full) {
    if (runs->empty()) settings.runs = 100;
    if (scale->empty()) settings.scale = 1000;
    if (cap->empty()) settings.cap_s = 60.0;
  }
  settings.literal = !arguments.no_literal;
  settings.referee = !arguments.no_referee;
  if (!arguments.write_folder.empty()) {
    const bool written = write_instances(arguments);
    if (!written) std::fprintf(stderr, "%s: cannot write there\n", arguments.write_folder.c_str());
    return to_int(written ? stepwright::result::ExitCode::Done : stepwright::result::ExitCode::BadInput);
  }
  std::string folder = (std::filesystem::temp_directory_path() / "bench_fleet_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) {
    std::fprintf(stderr, "bench_fleet: no folder for the referee's file\n");
    return to_int(stepwright::result::ExitCode::RuntimeFault);
  }
  settings.folder = folder;
  Kept kept(arguments.kept_file);
  settings.kept = arguments.kept_file.empty() ? nullptr : &kept;
  const int code = run(arguments);
  std::filesystem::remove_all(folder);
  return code;
}

// A shift of forklifts in a warehouse: on the simulated plant with a judge of its own, and what-if runs over
// the number of vehicles, beside first-come-first-served locks.
//
//   bench_shift [--vehicles N] [--hours H] [--rate R] [--seed S] [--until S] [--json FILE] [--svg FILE]
//               [--log]
//   bench_shift --sweep [--sizes 1,2,...] [--threads N] [--validate] [--hours H] [--rate R]
//               [--json FILE] [--svg FILE]
//
// Times are CPU times of one thread, of a sweep those of all threads and wall time. Exit code 5 if there was
// a collision or a deadlock.

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "runtime/ground/result/exit_code.h"
#include "tests/bench/shift/report.h"

namespace stepwright::bench::shift {
namespace {

constexpr std::uint32_t kMostVehicles = 50;

// Whether costs of ways to stations and homes are worked out before the shift.
enum class Ways : std::uint8_t { Searched, Known };

struct Arguments {
  ScenarioSettings settings;
  Ways ways = Ways::Known;
  bool sweep = false;
  bool validate = false;
  bool log = false;
  bool no_baseline = false;
  std::vector<std::uint32_t> sizes;
  unsigned threads = 2;
  double until_s = 1e9;
  double path_weight = fleet::RouteSettings().path_weight;
  std::string json_file, svg_file;
};

bool write(const std::string& file, const std::string& text) {
  if (file.empty()) return true;
  std::ofstream out(file);
  out << text;
  out.flush();
  if (!out) std::fprintf(stderr, "%s: cannot be written\n", file.c_str());
  return out.good();
}

nlohmann::json json_of(const Summary& s) {
  return {{"released", s.released},
          {"delivered", s.delivered},
          {"late", s.late},
          {"mean_tardiness_s", s.mean_tardiness_s},
          {"mean_delivery_s", s.mean_delivery_s},
          {"utilisation", s.utilisation}};
}

void print(const char* name, std::uint32_t vehicles, const Summary& s, double cpu) {
  std::printf(
      "%-8s %3u vehicles: %5zu of %zu delivered, %5zu late, tardiness %6.0f s, %5.0f s from release, jobs "
      "%3.0f %%, CPU %.1f s\n",
      name, vehicles, s.delivered, s.released, s.late, s.mean_tardiness_s, s.mean_delivery_s,
      100.0 * s.utilisation, cpu);
  std::fflush(stdout);
}

// First come, first served, beside the timed model of the same transports.
nlohmann::json baseline(const Scenario& scenario, Fleet& fleet, std::uint32_t vehicles) {
  const ShiftFigures timed = run_timed(scenario, fleet, vehicles);
  const double begin_s = cpu_s();
  const LockFigures locks = run_with_locks(scenario, fleet, vehicles);
  const Summary ours = summary_of(scenario, timed), theirs = summary_of(scenario, locks.figures);
  print("timed", vehicles, ours, timed.cpu_s);
  print("locks", vehicles, theirs, cpu_s() - begin_s);
  std::printf("         first come, first served: %u deadlocks, each cleared by hand\n", locks.deadlocks);
  nlohmann::json json = {{"vehicles", vehicles}, {"timed", json_of(ours)}, {"locks", json_of(theirs)}};
  json["locks"]["deadlocks"] = locks.deadlocks;
  return json;
}

std::unique_ptr<Fleet> fleet_of(const Arguments& arguments, const Scenario& scenario) {
  auto fleet = std::make_unique<Fleet>(scenario, scenario.settings.vehicles, arguments.path_weight);
  if (arguments.ways == Ways::Known) fleet->prepare();
  return fleet;
}

int run_shift(const Arguments& arguments) {
  const Scenario scenario = draw_scenario(arguments.settings);
  const auto made = fleet_of(arguments, scenario);
  const PlantRun run = run_on_plant(scenario, *made, arguments.log, arguments.until_s);
  if (!run.failed.empty()) {
    std::fprintf(stderr, "bench_shift: %s\n", run.failed.c_str());
    return to_int(result::ExitCode::RuntimeFault);
  }
  // On an empty floor, with the same kind of ways.
  const auto fresh = fleet_of(arguments, scenario);
  Fleet& fleet = *fresh;
  const std::vector<bool> kept = can_be_kept(scenario, fleet, arguments.settings.vehicles);
  if (arguments.log) {
    for (const std::string& line : run.log) std::printf("%s\n", line.c_str());
  }
  std::fputs(text_of(scenario, run, kept).c_str(), stdout);
  nlohmann::json json = json_of(scenario, run, kept);
  if (!arguments.no_baseline) json["baseline"] = baseline(scenario, fleet, arguments.settings.vehicles);
  const bool written =
      write(arguments.json_file, json.dump(2) + "\n") && write(arguments.svg_file, picture_of(scenario, run));
  if (!written) return to_int(result::ExitCode::BadInput);
  const bool sound = run.collisions.empty() && run.deadlocks.empty() && run.broken.empty();
  return to_int(sound ? result::ExitCode::Done : result::ExitCode::RuntimeFault);
}

// All sizes on the same ways, several at a time; each size gives the same rows whatever runs beside it.
std::vector<SweepRow> rows_of(const Arguments& arguments, const Scenario& scenario, Fleet& fleet) {
  std::vector<SweepRow> rows(arguments.sizes.size());
  std::atomic<std::size_t> next = 0;
  std::mutex printing;
  const auto work = [&] {
    for (std::size_t k = next++; k < rows.size(); k = next++) {
      const std::uint32_t vehicles = arguments.sizes[k];
      const ShiftFigures figures = run_timed(scenario, fleet, vehicles);
      rows[k] = {vehicles, summary_of(scenario, figures), figures.cpu_s};
      const std::lock_guard lock(printing);
      print("timed", vehicles, rows[k].summary, figures.cpu_s);
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (unsigned k = 1; k < arguments.threads; ++k) helpers.emplace_back(work);
    work();
  }
  return rows;
}

int run_sweep(const Arguments& arguments) {
  ScenarioSettings settings = arguments.settings;
  settings.vehicles = kMostVehicles;
  const Scenario scenario = draw_scenario(settings);
  const double begin_s = process_cpu_s();
  const auto begin = std::chrono::steady_clock::now();
  Fleet fleet(scenario, kMostVehicles);
  fleet.prepare();
  const std::vector<SweepRow> rows = rows_of(arguments, scenario, fleet);
  nlohmann::json json;
  for (const SweepRow& row : rows) {
    json["rows"].push_back(json_of(row.summary));
    json["rows"].back()["vehicles"] = row.vehicles;
    json["rows"].back()["cpu_s"] = row.cpu_s;
  }
  const double cpu = process_cpu_s() - begin_s;
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  json["sweep_cpu_s"] = cpu;
  json["sweep_wall_s"] = wall;
  json["prepare_cpu_s"] = fleet.prepare_cpu_s();
  json["enough_vehicles"] = enough_vehicles(rows);
  std::printf(
      "sweep: %.1f s, CPU %.1f s (%.1f s of it for costs of ways, once), %llu paths; %u vehicles suffice\n",
      wall, cpu, fleet.prepare_cpu_s(), static_cast<unsigned long long>(fleet.planner().paths_planned()),
      enough_vehicles(rows));
  for (const std::uint32_t vehicles : {5U, 10U, 20U}) {
    if (!arguments.validate) break;
    settings.vehicles = vehicles;
    const Scenario smaller = draw_scenario(settings);
    const auto fleet_there = fleet_of(arguments, smaller);
    const PlantRun run = run_on_plant(smaller, *fleet_there, false);
    print("plant", vehicles, summary_of(smaller, run.figures), run.figures.cpu_s);
    json["plant"].push_back(json_of(summary_of(smaller, run.figures)));
    json["plant"].back()["vehicles"] = vehicles;
  }
  const bool written = write(arguments.json_file, json.dump(2) + "\n") &&
                       write(arguments.svg_file, plot_of(rows, settings.hours));
  return to_int(written ? result::ExitCode::Done : result::ExitCode::BadInput);
}

}  // namespace
}  // namespace stepwright::bench::shift

int main(int argc, char** argv) {
  using namespace stepwright::bench::shift;
  Arguments arguments;
  ScenarioSettings& settings = arguments.settings;
  CLI::App app("a shift of forklifts on the simulated floor, and how many of them suffice", "bench_shift");
  app.add_option("--vehicles", settings.vehicles)->check(CLI::Range(1U, kMostVehicles));
  app.add_option("--hours", settings.hours)->check(CLI::Range(0.02, 24.0));
  app.add_option("--rate", settings.transports_per_hour, "transports an hour")
      ->check(CLI::Range(1.0, 1000.0));
  app.add_option("--seed", settings.seed);
  app.add_option("--until", arguments.until_s, "seconds of the shift that are driven; default: all of it")
      ->check(CLI::Range(1.0, 1e9));
  app.add_option("--path-weight", arguments.path_weight,
                 "of ways searched: they cost at most so many times the least")
      ->check(CLI::Range(1.0, 10.0));
  app.add_option("--ways", arguments.ways, "searched one by one, or with their costs known before")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Ways>{{"searched", Ways::Searched}, {"known", Ways::Known}}));
  app.add_flag("--sweep", arguments.sweep, "the timed model over the number of vehicles");
  app.add_option("--sizes", arguments.sizes, "of the sweep; default 1 to 50")
      ->delimiter(',')
      ->check(CLI::Range(1U, kMostVehicles));
  app.add_option("--threads", arguments.threads, "of the sweep")->check(CLI::Range(1U, 64U));
  app.add_flag("--validate", arguments.validate, "5, 10 and 20 vehicles of the sweep on the plant as well");
  app.add_flag("--log", arguments.log, "what happened, and progress on the error output");
  app.add_flag("--no-baseline", arguments.no_baseline);
  app.add_option("--json", arguments.json_file);
  app.add_option("--svg", arguments.svg_file);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : to_int(stepwright::result::ExitCode::Usage);
  }
  if (arguments.sizes.empty()) {
    for (std::uint32_t n = 1; n <= kMostVehicles; ++n) arguments.sizes.push_back(n);
  }
  return arguments.sweep ? run_sweep(arguments) : run_shift(arguments);
}

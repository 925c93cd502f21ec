// Paths of arms, whole problems (problem_sets.h), ours beside OMPL in the same run.
//
//   bench_arm [--full] [--json FILE] [--robot panda|ur5|own] [--per-scenario N]

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/bench/arm/baselines.h"
#include "tests/bench/arm/measure.h"

namespace stepwright::bench {
namespace {

using nlohmann::json;

struct Options {
  bool full = false;
  std::string json_file, robot;
  std::size_t per_scenario = 3;
  double protrusion_m = 0.01;
};

json times(const std::vector<double>& values) {
  return {{"median_ms", quantile(values, 0.5)}, {"p95_ms", quantile(values, 0.95)}, {"count", values.size()}};
}

void print(const char* what, const std::vector<double>& values, const std::string& more = {}) {
  std::printf("  %-58s median %9.3f ms, p95 %9.2f ms (%zu)%s\n", what, quantile(values, 0.5),
              quantile(values, 0.95), values.size(), more.c_str());
}

json baseline(const char* what, const BaselineFigures& figures) {
  char more[96];
  std::snprintf(more, sizeof more, " of %zu, range %.1f", figures.asked, figures.range);
  print(what, figures.solve_ms, more);
  json out = times(figures.solve_ms);
  out["asked"] = figures.asked;
  out["range"] = figures.range;
  return out;
}

json measure(const ProblemSet& set, const Options& options) {
  for (const auto& [a, b] : set.pairs.pairs)
    std::printf("  spheres of %s and %s often overlap, their bodies seldom do: FCL is asked of them\n",
                set.model.robot.links[static_cast<std::size_t>(a)].name.c_str(),
                set.model.robot.links[static_cast<std::size_t>(b)].name.c_str());
  const OwnFigures own = measure_ours(set);
  const double percent =
      100.0 * static_cast<double>(own.solved) / static_cast<double>(std::max<std::size_t>(own.valid, 1));
  std::printf(
      "  %zu problems, %zu valid by FCL, %zu solved (%.2f %%): %zu with ways out, %zu by the bodies; %zu "
      "spheres; rechecked paths that collide: %zu\n",
      own.problems, own.valid, own.solved, percent, own.by_ways, own.by_bodies, set.model.spheres.count(),
      own.collisions);
  for (const std::string& each : own.unsolved) std::printf("  not solved: %s\n", each.c_str());
  print("ours, spheres: first path", own.first_ms);
  print("ours, spheres: shortened", own.shortened_ms);
  print("ours, judged by FCL as a whole", own.certain_ms);
  const double patience_s = options.full ? 20.0 : 5.0;
  json out = {{"problems", own.problems},
              {"valid", own.valid},
              {"solved", own.solved},
              {"solved_percent", percent},
              {"by_ways_out", own.by_ways},
              {"by_bodies", own.by_bodies},
              {"recheck_collisions", own.collisions},
              {"unsolved", own.unsolved},
              {"spheres", set.model.spheres.count()},
              {"first_path", times(own.first_ms)},
              {"shortened", times(own.shortened_ms)},
              {"judged", times(own.certain_ms)}};
  const BaselineFigures places = ompl_on_spheres(set, own.measured, false, patience_s);
  out["ompl_places"] = baseline("OMPL RRTConnect, same spheres, its motions", places);
  const BaselineFigures whole = ompl_on_spheres(set, own.measured, true, patience_s);
  out["ompl_whole_motions"] = baseline("OMPL RRTConnect, same spheres, our motions", whole);
  std::vector<std::size_t> few;
  for (std::size_t k = 0; k < own.measured.size(); k += options.full ? 10 : 3) few.push_back(own.measured[k]);
  out["ompl_fcl"] = baseline("OMPL RRTConnect, FCL on the bodies", ompl_on_bodies(set, few, patience_s));
  const double ours = quantile(own.first_ms, 0.5);
  out["ratio_to_ompl"] = quantile(places.solve_ms, 0.5) / ours;
  out["ratio_to_ompl_p95"] = quantile(places.solve_ms, 0.95) / quantile(own.first_ms, 0.95);
  out["ratio_to_ompl_our_motions"] = quantile(whole.solve_ms, 0.5) / ours;
  std::printf(
      "  ratio to OMPL on the same spheres: %.1f at the median, %.1f at p95; with our motions in it %.1f\n",
      out["ratio_to_ompl"].get<double>(), out["ratio_to_ompl_p95"].get<double>(),
      out["ratio_to_ompl_our_motions"].get<double>());
  return out;
}

int run(const Options& options) {
  const std::size_t per_scenario = options.full ? 100 : options.per_scenario;
  const auto arms = arms_folder();
  if (!arms) std::printf("data/arms is not on this machine: own scenes instead\n");
  std::vector<std::string> robots{"panda", "ur5"};
  if (!options.robot.empty()) robots = {options.robot};
  if (!arms) robots = {"own"};
  json out;
  std::size_t valid = 0, solved = 0, collisions = 0;
  double ratio = 1e9;
  for (const std::string& robot : robots) {
    std::printf("%s\n", robot.c_str());
    std::fflush(stdout);
    const ProblemSet set = robot == "own"
                               ? problems_of_our_own(7 * per_scenario, options.protrusion_m)
                               : problems_of_others(*arms, robot, per_scenario, options.protrusion_m);
    const json one = measure(set, options);
    valid += one["valid"].get<std::size_t>();
    solved += one["solved"].get<std::size_t>();
    collisions += one["recheck_collisions"].get<std::size_t>();
    ratio = std::min(ratio, one["ratio_to_ompl"].get<double>());
    out["arm_" + robot] = one;
  }
  out["arm_solved_percent"] =
      100.0 * static_cast<double>(solved) / static_cast<double>(std::max<std::size_t>(valid, 1));
  out["arm_ratio_to_ompl"] = ratio;
  out["arm_recheck_collisions"] = collisions;
  std::printf("solved %.2f %% of the valid ones; at least %.1f times as fast as OMPL; %zu paths collide\n",
              out["arm_solved_percent"].get<double>(), ratio, collisions);
  if (options.json_file.empty()) return 0;
  std::ofstream file(options.json_file);
  file << out.dump(2) << "\n";
  return file.flush() ? 0 : 1;
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  CLI::App app("Paths of arms: ours beside OMPL", "bench_arm");
  stepwright::bench::Options options;
  app.add_flag("--full", options.full, "all 700 problems of each robot");
  app.add_option("--json", options.json_file, "write the figures");
  app.add_option("--robot", options.robot, "only this one")->check(CLI::IsMember({"panda", "ur5", "own"}));
  app.add_option("--per-scenario", options.per_scenario, "problems of each scenario (default 3)")
      ->check(CLI::Range(1, 100));
  app.add_option("--protrusion", options.protrusion_m, "of the spheres, in metres (default 0.01)");
  CLI11_PARSE(app, argc, argv);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  try {
    return stepwright::bench::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_arm: %s\n", error.what());
    return 1;
  }
}

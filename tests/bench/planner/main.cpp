// The planner on the tank bench, both variants: time to the first plan and to the proof, beside a plain
// uniform-cost search in the same run. Times are medians; CPU time is what compares on a busy machine.
//
//   bench_planner [--repeats N] [--json FILE]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/result/exit_code.h"
#include "supervisor/pddl/solve.h"
#include "tests/bench/planner/uniform_cost.h"

namespace stepwright::bench {
namespace {

using result::ExitCode;

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double cpu_ms() {
  return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Times {
  std::vector<double> wall, cpu;
};

template <typename Run>
void measure(Times& times, const Run& run) {
  const double wall = wall_ms();
  const double cpu = cpu_ms();
  run();
  times.wall.push_back(wall_ms() - wall);
  times.cpu.push_back(cpu_ms() - cpu);
}

nlohmann::json run_variant(const std::string& name, const pddl::Task& task, int repeats) {
  Times first, optimal, baseline;
  model::Outcome outcome;
  UniformCost plain;
  for (int i = 0; i < repeats; ++i) {
    pddl::Options options;
    options.first_only = true;
    measure(first, [&] { outcome = pddl::solve(task, options); });
    options = {};
    options.optimal = true;
    measure(optimal, [&] { outcome = pddl::solve(task, options); });
    measure(baseline, [&] { plain = uniform_cost(task); });
  }
  const double ratio = median(baseline.cpu) / std::max(1e-3, median(optimal.cpu));
  std::printf("%-6s first plan %8.2f ms wall %8.2f ms cpu\n", name.c_str(), median(first.wall),
              median(first.cpu));
  std::printf(
      "       optimal    %8.2f ms wall %8.2f ms cpu   cost %g in %zu steps, proved %s, %llu expanded\n",
      median(optimal.wall), median(optimal.cpu), outcome.plan->cost, outcome.plan->actions.size(),
      outcome.plan->proved_optimal ? "yes" : "no", static_cast<unsigned long long>(outcome.expanded));
  std::printf(
      "       baseline   %8.2f ms wall %8.2f ms cpu   cost %g in %u steps, %llu expanded; ratio %.1f\n",
      median(baseline.wall), median(baseline.cpu), plain.cost, plain.steps,
      static_cast<unsigned long long>(plain.expanded), ratio);
  return {{"variant", name},
          {"first_plan_ms", median(first.wall)},
          {"first_plan_cpu_ms", median(first.cpu)},
          {"optimal_plan_ms", median(optimal.wall)},
          {"optimal_plan_cpu_ms", median(optimal.cpu)},
          {"plan_cost", outcome.plan->cost},
          {"plan_steps", outcome.plan->actions.size()},
          {"proved_optimal", outcome.plan->proved_optimal},
          {"expanded", outcome.expanded},
          {"baseline_ms", median(baseline.wall)},
          {"baseline_cpu_ms", median(baseline.cpu)},
          {"baseline_cost", plain.cost},
          {"baseline_steps", plain.steps},
          {"baseline_expanded", plain.expanded},
          {"cpu_ratio", ratio}};
}

int run(int repeats, const std::string& json_file) {
  nlohmann::json report = {{"variants", nlohmann::json::array()}};
  for (const std::string variant : {"", "_load"}) {
    const std::string folder = std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/bench/";
    const auto task =
        pddl::load_task(folder + "domain" + variant + ".pddl", folder + "problem" + variant + ".pddl");
    if (!task) {
      std::fprintf(stderr, "%s\n", result::to_string(task.error()).c_str());
      return to_int(ExitCode::BadInput);
    }
    report["variants"].push_back(run_variant(variant.empty() ? "bench" : "load", *task, repeats));
  }
  if (json_file.empty()) return to_int(ExitCode::Done);
  std::ofstream file(json_file);
  file << report.dump(2) << "\n";
  return to_int(file ? ExitCode::Done : ExitCode::BadInput);
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  int repeats = 9;
  std::string json_file;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--repeats") == 0) repeats = std::max(1, std::atoi(argv[i + 1]));
    if (std::strcmp(argv[i], "--json") == 0) json_file = argv[i + 1];
  }
  return stepwright::bench::run(repeats, json_file);
}

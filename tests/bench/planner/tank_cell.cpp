#include "tests/bench/planner/tank_cell.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/planner/solve.h"
#include "tests/bench/planner/baseline/uniform_cost.h"
#include "tests/bench/planner/report/domain_figures.h"

namespace stepwright::bench {
namespace {

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double cpu_ms() {
  return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
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

void print(const std::string& name, const Times& times, const std::string& rest) {
  std::printf("%-16s %8.2f ms wall %8.2f ms cpu  %s\n", name.c_str(), median(times.wall), median(times.cpu),
              rest.c_str());
}

nlohmann::json run_variant(const std::string& name, const pddl::Source& domain, const pddl::Source& problem,
                           const pddl::Task& task, int repeats) {
  Times grounding, first, optimal, baseline;
  model::Outcome outcome;
  UniformCost plain;
  for (int i = 0; i < repeats; ++i) {
    measure(grounding, [&] {
      const auto read = pddl::parse_task(domain, problem);
      (void)pddl::ground_task(read->definition(), [] { return false; });
    });
    pddl::Options options;
    options.first_only = true;
    measure(first, [&] { outcome = pddl::solve(task, options); });
    options = {};
    options.optimal = true;
    measure(optimal, [&] { outcome = pddl::solve(task, options); });
    measure(baseline, [&] { plain = uniform_cost(task); });
  }
  const double ratio = median(baseline.cpu) / std::max(1e-3, median(optimal.cpu));
  const auto found = [](double cost, std::size_t steps, std::uint64_t expanded) {
    char text[128];
    std::snprintf(text, sizeof text, "cost %g in %zu steps, %llu expanded", cost, steps,
                  static_cast<unsigned long long>(expanded));
    return std::string(text);
  };
  print(name + " grounding", grounding, "from the texts");
  print(name + " first", first, "");
  print(name + " optimal", optimal,
        found(outcome.plan->cost, outcome.plan->actions.size(), outcome.expanded) +
            (outcome.plan->proved_optimal ? ", proved" : ", not proved"));
  print(name + " plain", baseline,
        found(plain.cost, plain.steps, plain.expanded) + "; ratio " + std::to_string(ratio));
  return {{"variant", name},
          {"grounding_ms", median(grounding.wall)},
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

}  // namespace

result::Result<nlohmann::json> measure_tank_cell(int repeats) {
  nlohmann::json report = {{"variants", nlohmann::json::array()}};
  for (const std::string variant : {"", "_load"}) {
    const std::string folder = std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/bench/";
    auto domain = pddl::read_source(folder + "domain" + variant + ".pddl");
    if (!domain) return result::forward(domain);
    auto problem = pddl::read_source(folder + "problem" + variant + ".pddl");
    if (!problem) return result::forward(problem);
    auto task = pddl::parse_task(*domain, *problem);
    if (!task) return result::forward(task);
    report["variants"].push_back(
        run_variant(variant.empty() ? "bench" : "load", *domain, *problem, *task, repeats));
  }
  report["grounding_ms_bench"] = report["variants"][0]["grounding_ms"];
  report["optimal_ms_bench"] = report["variants"][0]["optimal_plan_ms"];
  return report;
}

}  // namespace stepwright::bench

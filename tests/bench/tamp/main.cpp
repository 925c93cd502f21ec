// bench_tamp: problems P1 to P6 of Karlsson et al. 2012 at the paper's resolutions, ours beside the paper's
// geometric backtracking in the same process: the same inverse kinematics, paths and checks. Every plan is
// judged by driving through it. Times are of the processor. Then trays with less and less slack.
//
// usage: bench_tamp [--json FILE] [--full] [--seeds N] [--time S]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"
#include "supervisor/tamp/judge/plan_judge.h"
#include "supervisor/tamp/planner/tamp_planner.h"
#include "tests/support/tamp_cells/paper_cells.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;
using tamp::planner::IntervalModel;
using tamp::planner::Method;
using tamp::planner::TampOutcome;

struct Settings {
  const char* json_file = nullptr;
  bool full = false;
  int seeds = 3;
  double time_s = 10.0;  // of each run of paper-literal
};

struct Resolution {
  std::size_t grasps, places;
};

// Table 1 of the paper; the finest first.
const std::map<std::string, std::vector<Resolution>> kResolutions = {
    {"p1", {{6, 60}, {2, 60}}},
    {"p2", {{16, 120}, {6, 60}, {2, 30}}},
    {"p3", {{16, 120}, {6, 60}, {2, 60}}},
    {"p4", {{16, 120}, {12, 60}, {6, 60}}},
    {"p5", {{16, 120}, {6, 60}, {2, 30}}},
    {"p6", {{16, 120}, {6, 60}, {2, 60}}},
};

struct Runs {
  std::vector<double> ms, certify_ms, failed, configurations;
  int runs = 0, solved = 0, refused = 0;

  double percent() const { return runs == 0 ? 0.0 : 100.0 * solved / runs; }
};

double middle(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}
double largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::ranges::max_element(values);
}

// One run, judged; its time counts whether it was solved or not.
void run(const tamp::test::PaperProblem& problem, Method method, std::uint64_t seed, double time_s,
         Runs& runs) {
  std::optional<IntervalModel> model;
  if (method == Method::Ours) model.emplace(problem.cell);
  tamp::planner::TampOptions options;
  options.method = method;
  options.seed = seed;
  options.until = Clock::now() + std::chrono::microseconds(static_cast<long long>(time_s * 1e6));
  const TampOutcome outcome =
      tamp::planner::plan(problem.cell, problem.task, model ? &*model : nullptr, options);
  ++runs.runs;
  runs.ms.push_back(outcome.figures.plan_cpu_ms);
  runs.failed.push_back(static_cast<double>(outcome.figures.failed));
  runs.configurations.push_back(static_cast<double>(outcome.figures.configurations));
  if (!outcome.plan) {
    if (method == Method::Ours)
      std::fprintf(stderr, "ours, seed %d: %s\n", static_cast<int>(seed), outcome.reason.c_str());
    return;
  }
  runs.certify_ms.push_back(outcome.figures.certify_ms);
  const tamp::judge::Judgement judged = tamp::judge::judge(problem.cell, *outcome.plan);
  if (judged.sound) {
    ++runs.solved;
  } else {
    ++runs.refused;
    std::fprintf(stderr, "the judge refuses a plan: %s\n", judged.reason.c_str());
  }
}

// paper-literal in both readings (geometric_backtracking.h); what ours is compared with is the better one.
// And with samples from number 1 on, as books count them, whose failures are nearer to those of the paper.
struct Pair {
  Runs ours, all_ways, first_way, from_one;

  const Runs& literal() const {
    if (all_ways.solved != first_way.solved) return all_ways.solved > first_way.solved ? all_ways : first_way;
    return middle(all_ways.ms) < middle(first_way.ms) ? all_ways : first_way;
  }
};

Pair measure(const std::string& name, Resolution resolution, const Settings& settings,
             std::optional<double> slack_m) {
  Pair pair;
  for (int seed = 1; seed <= settings.seeds; ++seed) {
    auto problem = tamp::test::paper_problem(name);
    if (!problem) continue;
    tamp::test::move_things(problem->cell, static_cast<std::uint64_t>(seed));
    if (slack_m) tamp::test::set_slack(problem->cell, *slack_m);
    problem->cell.manner.grasps = resolution.grasps;
    problem->cell.manner.places = resolution.places;
    run(*problem, Method::Ours, static_cast<std::uint64_t>(seed), 60.0, pair.ours);
    run(*problem, Method::PaperLiteral, static_cast<std::uint64_t>(seed), settings.time_s, pair.all_ways);
    run(*problem, Method::PaperFirstWay, static_cast<std::uint64_t>(seed), settings.time_s, pair.first_way);
    run(*problem, Method::PaperFromOne, static_cast<std::uint64_t>(seed), settings.time_s, pair.from_one);
  }
  return pair;
}

// Of medians; where paper-literal was cut off it is a lower bound.
double ratio_of(const Runs& ours, const Runs& other) {
  return middle(ours.ms) > 0.0 ? middle(other.ms) / middle(ours.ms) : 0.0;
}
const char* bound_of(const Runs& runs) {
  return runs.solved < runs.runs ? " at least" : "";
}

void print(const std::string& name, const Pair& pair) {
  std::printf(
      "%-16s %5.0f %% %9.2f %9.1f %8.0f %8.0f   %5.0f %% %10.1f %10.0f %-9s %9.1f%s   %5.0f %% %10.1f %10.0f "
      "%9.1f%s\n",
      name.c_str(), pair.ours.percent(), middle(pair.ours.ms), middle(pair.ours.certify_ms),
      middle(pair.ours.failed), largest(pair.ours.failed), pair.literal().percent(),
      middle(pair.literal().ms), middle(pair.literal().failed),
      &pair.literal() == &pair.all_ways ? "all ways" : "first way", ratio_of(pair.ours, pair.literal()),
      bound_of(pair.literal()), pair.from_one.percent(), middle(pair.from_one.ms),
      middle(pair.from_one.failed), ratio_of(pair.ours, pair.from_one), bound_of(pair.from_one));
  std::fflush(stdout);
}

void heading(const char* what) {
  std::printf("\n%-16s %7s %9s %9s %8s %8s   %7s %10s %10s %-9s %9s   %7s %10s %10s %9s\n", what, "solved",
              "ms", "certify", "failed", "most", "literal", "ms", "failed", "reading", "ratio", "from 1",
              "ms", "failed", "ratio");
}

void measure_paper(const Settings& settings, nlohmann::json& json) {
  heading("problem");
  int runs = 0, solved = 0, literal_solved = 0, refused = 0;
  for (const auto& [name, resolutions] : kResolutions)
    for (std::size_t k = 0; k < (settings.full ? resolutions.size() : 1); ++k) {
      const Pair pair = measure(name, resolutions[k], settings, std::nullopt);
      print(name + " " + std::to_string(resolutions[k].grasps) + "x" + std::to_string(resolutions[k].places),
            pair);
      runs += pair.ours.runs;
      solved += pair.ours.solved;
      literal_solved += pair.literal().solved;
      refused += pair.ours.refused + pair.literal().refused;
      if (k > 0) continue;
      json["tamp_" + name + "_ms"] = middle(pair.ours.ms);
      json["tamp_" + name + "_certify_ms"] = middle(pair.ours.certify_ms);
      json["tamp_" + name + "_ratio"] = ratio_of(pair.ours, pair.literal());
      json["tamp_" + name + "_failed"] = largest(pair.ours.failed);
      json["tamp_" + name + "_literal_failed"] = middle(pair.literal().failed);
      json["tamp_" + name + "_literal_solved_percent"] = pair.literal().percent();
      json["tamp_" + name + "_from_one_ratio"] = ratio_of(pair.ours, pair.from_one);
      json["tamp_" + name + "_from_one_failed"] = middle(pair.from_one.failed);
      json["tamp_" + name + "_from_one_solved_percent"] = pair.from_one.percent();
    }
  json["tamp_solved_percent"] = runs == 0 ? 0.0 : 100.0 * solved / runs;
  json["tamp_literal_solved_percent"] = runs == 0 ? 0.0 : 100.0 * literal_solved / runs;
  json["tamp_refused"] = refused;
}

void measure_slack(const Settings& settings, nlohmann::json& json) {
  heading("slack");
  Settings less = settings;
  if (!settings.full) less.seeds = 1;
  const std::vector<double> all =
      settings.full ? std::vector<double>{20, 15, 10, 7, 5, 3, 2, 1} : std::vector<double>{20, 10, 5, 1};
  for (const std::string name : {"p2", "p3", "p4"}) {
    if (!settings.full && name != "p4") continue;
    for (const double slack_mm : all) {
      const Pair pair = measure(name, kResolutions.at(name).front(), less, slack_mm * 1e-3);
      print(name + " " + std::to_string(static_cast<int>(slack_mm)) + " mm", pair);
      json["tamp_sweep"].push_back({{"problem", name},
                                    {"slack_mm", slack_mm},
                                    {"solved_percent", pair.ours.percent()},
                                    {"ms", middle(pair.ours.ms)},
                                    {"literal_solved_percent", pair.literal().percent()},
                                    {"literal_ms", middle(pair.literal().ms)}});
    }
  }
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  using stepwright::result::ExitCode;
  using stepwright::result::to_int;
  stepwright::bench::Settings settings;
  for (int i = 1; i < argc; ++i) {
    const bool more = i + 1 < argc;
    if (std::strcmp(argv[i], "--json") == 0 && more) {
      settings.json_file = argv[++i];
    } else if (std::strcmp(argv[i], "--full") == 0) {
      settings.full = true;
      settings.seeds = 10;
      settings.time_s = 300.0;
    } else if (std::strcmp(argv[i], "--seeds") == 0 && more) {
      settings.seeds = std::max(1, std::atoi(argv[++i]));
    } else if (std::strcmp(argv[i], "--time") == 0 && more) {
      settings.time_s = std::max(0.1, std::atof(argv[++i]));
    } else {
      std::fprintf(stderr, "usage: bench_tamp [--json FILE] [--full] [--seeds N] [--time S]\n");
      return to_int(ExitCode::Usage);
    }
  }
  nlohmann::json json;
  stepwright::bench::measure_paper(settings, json);
  stepwright::bench::measure_slack(settings, json);
  if (settings.json_file != nullptr) std::ofstream(settings.json_file) << json.dump(1) << "\n";
  return to_int(json["tamp_refused"] == 0 ? ExitCode::Done : ExitCode::RuntimeFault);
}

// bench_ltl: a train plans the tasks of E. Plaku 2012 (phi1: eight places in succession, phi2 as printed:
// three of them, phi3: all of them) on both published scenes. A run is everything: triangles, automaton,
// search, referee. Baselines, in the same run: the same search without the guide, which looks for routes on
// all sides alike; and OMPL's LTLPlanner on the same triangles, automaton, motion and walls, with the best of
// four times of exploring in each cell, where its plan counts if the referee accepts it. A run without a plan
// counts ten times its time.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"
#include "supervisor/ltl/planner/plan_train.h"
#include "tests/bench/ltl/ltl_planner.h"
#include "tests/bench/ltl/train_problem.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  const char* json_file = nullptr;
  int seeds = 10;
  double most_s = 10.0;
  int ompl_seeds = 1;  // of LTLPlanner, which takes its time; 0: without it
};

struct Cell {
  std::vector<double> times_ms;
  std::vector<double> lengths_m;
  int solved = 0;
  int refused = 0;  // plans that the referee did not accept, before the one that it did

  double median_ms() const { return middle(times_ms); }
  double worst_ms() const { return times_ms.empty() ? 0.0 : *std::ranges::max_element(times_ms); }
  static double middle(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    return values[values.size() / 2];
  }
};

void run_once(const ltl::Problem& problem, std::uint64_t seed, ltl::SearchGuide guide, double most_s,
              Cell& cell) {
  const auto began = Clock::now();
  const auto answer = ltl::plan_train(problem, {.seed = seed, .most_s = most_s, .guide = guide});
  const double spent_ms = std::chrono::duration<double, std::milli>(Clock::now() - began).count();
  cell.times_ms.push_back(answer ? spent_ms : 10'000.0 * most_s);
  if (!answer) return;
  ++cell.solved;
  cell.refused += static_cast<int>(answer->tries) - 1;
  cell.lengths_m.push_back(answer->plan.length_m);
}

// The best of its times of exploring, by the medians; how many plans the referee did not accept is `refused`.
Cell run_ltlplanner(const ltl::Floor& floor, const std::string& task, std::size_t trailers,
                    const Options& options) {
  Cell best;
  for (const double explore_s : {0.02, 0.1, 0.5, 1.0}) {
    Cell cell;
    for (int seed = 1; seed <= options.ompl_seeds; ++seed) {
      const ltl::Problem problem = train_problem(floor, task, trailers, static_cast<std::uint64_t>(seed));
      const OmplAnswer answer = plan_by_ltlplanner(problem, explore_s, options.most_s);
      const bool accepted = answer.plan && answer.judgement.accepted();
      cell.times_ms.push_back(accepted ? 1e3 * answer.spent_s : 10'000.0 * options.most_s);
      if (answer.plan && !accepted) ++cell.refused;
      if (!accepted) continue;
      ++cell.solved;
      cell.lengths_m.push_back(answer.plan->length_m);
    }
    if (best.times_ms.empty() || cell.median_ms() < best.median_ms()) best = std::move(cell);
  }
  return best;
}

int run(const Options& options) {
  seed_ompl(1);
  std::map<std::size_t, std::vector<double>> ratios;  // by trailers
  nlohmann::json json;
  int solved = 0, cells = 0;
  std::printf("%-8s %-5s %3s  %7s %10s %10s %8s %7s  %7s %10s %6s  %7s %10s %8s\n", "scene", "task", "N",
              "solved", "median ms", "worst ms", "length m", "refused", "uniform", "median ms", "ratio",
              "OMPL", "median ms", "ratio");
  for (const std::string scene : {"blocks", "walls"}) {
    const auto floor = published_floor(scene + ".geojson");
    if (!floor) return result::to_int(result::ExitCode::BadInput);
    const std::pair<const char*, std::string> tasks[] = {{"phi1", ltl::test::in_succession(8)},
                                                         {"phi2", ltl::test::five_visits(8, false)},
                                                         {"phi3", ltl::test::coverage(8)}};
    for (const auto& [name, task] : tasks) {
      for (const std::size_t trailers : {0, 5, 10, 15}) {
        Cell ours, uniform;
        for (int seed = 1; seed <= options.seeds; ++seed) {
          const auto at = static_cast<std::uint64_t>(seed);
          const ltl::Problem problem = train_problem(*floor, task, trailers, at);
          run_once(problem, at, ltl::SearchGuide::OnTheRegions, options.most_s, ours);
          run_once(problem, at, ltl::SearchGuide::None, options.most_s, uniform);
        }
        const double ratio = uniform.median_ms() / ours.median_ms();
        const Cell ompl = options.ompl_seeds > 0 ? run_ltlplanner(*floor, task, trailers, options) : Cell{};
        const double ompl_ratio = ompl.median_ms() / ours.median_ms();
        if (options.ompl_seeds > 0) ratios[trailers].push_back(ompl_ratio);
        std::printf(
            "%-8s %-5s %3zu  %3d/%-3d %10.1f %10.1f %8.1f %7d  %3d/%-3d %10.1f %6.2f  %3d/%-3d %10.1f "
            "%8.1f\n",
            scene.c_str(), name, trailers, ours.solved, options.seeds, ours.median_ms(), ours.worst_ms(),
            Cell::middle(ours.lengths_m), ours.refused, uniform.solved, options.seeds, uniform.median_ms(),
            ratio, ompl.solved, options.ompl_seeds, ompl.median_ms(), ompl_ratio);
        std::fflush(stdout);
        json["rows"].push_back({{"scene", scene},
                                {"task", name},
                                {"trailers", trailers},
                                {"solved", ours.solved},
                                {"median_ms", ours.median_ms()},
                                {"worst_ms", ours.worst_ms()},
                                {"length_m", Cell::middle(ours.lengths_m)},
                                {"refused", ours.refused},
                                {"uniform_solved", uniform.solved},
                                {"uniform_median_ms", uniform.median_ms()},
                                {"ratio_to_uniform", ratio},
                                {"ltlplanner_solved", ompl.solved},
                                {"ltlplanner_refused", ompl.refused},
                                {"ltlplanner_median_ms", ompl.median_ms()},
                                {"ratio_to_ltlplanner", ompl_ratio}});
        solved += ours.solved;
        ++cells;
      }
    }
  }
  json["solved"] = solved;
  json["asked"] = cells * options.seeds;
  json["cells"] = cells;
  for (const auto& [trailers, all] : ratios) {
    json["ratio_to_ltlplanner_n" + std::to_string(trailers)] = Cell::middle(all);
    std::printf("%zu trailers: LTLPlanner takes %.1f times as long (median of the cells)\n", trailers,
                Cell::middle(all));
  }
  std::printf("solved %d of %d\n", solved, cells * options.seeds);
  if (options.json_file == nullptr) return result::to_int(result::ExitCode::Done);
  std::ofstream file(options.json_file);
  file << json.dump(2) << "\n";
  return result::to_int(file ? result::ExitCode::Done : result::ExitCode::BadInput);
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  stepwright::bench::Options options;
  bool known = true;
  for (int k = 1; k < argc; k += 2) {
    const auto is = [&](const char* option) { return k + 1 < argc && std::strcmp(argv[k], option) == 0; };
    if (is("--json"))
      options.json_file = argv[k + 1];
    else if (is("--seeds"))
      options.seeds = std::atoi(argv[k + 1]);
    else if (is("--time"))
      options.most_s = std::atof(argv[k + 1]);
    else if (is("--ompl-seeds"))
      options.ompl_seeds = std::atoi(argv[k + 1]);
    else
      known = false;
  }
  if (!known || options.seeds < 1 || !(options.most_s > 0.0) || options.ompl_seeds < 0) {
    std::fprintf(stderr, "usage: bench_ltl [--json FILE] [--seeds N] [--time SECONDS] [--ompl-seeds N]\n");
    return stepwright::result::to_int(stepwright::result::ExitCode::Usage);
  }
  return stepwright::bench::run(options);
}

// bench_ltl: a train plans the tasks of E. Plaku 2012 (phi1: eight places in succession, phi2 as printed:
// three of them, phi3: all of them) on both published scenes. A run is everything: triangles, automaton,
// search, referee. Baseline, in the same run: the same search without the guide, which looks for routes on
// all sides alike. A run without a plan counts ten times its time.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"
#include "supervisor/ltl/planner/plan_train.h"
#include "tests/bench/ltl/train_problem.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  const char* json_file = nullptr;
  int seeds = 10;
  double most_s = 10.0;
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

int run(const Options& options) {
  nlohmann::json json;
  int solved = 0, cells = 0;
  std::printf("%-8s %-5s %3s  %7s %10s %10s %8s %7s  %7s %10s %6s\n", "scene", "task", "N", "solved",
              "median ms", "worst ms", "length m", "refused", "uniform", "median ms", "ratio");
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
        std::printf("%-8s %-5s %3zu  %3d/%-3d %10.1f %10.1f %8.1f %7d  %3d/%-3d %10.1f %6.2f\n",
                    scene.c_str(), name, trailers, ours.solved, options.seeds, ours.median_ms(),
                    ours.worst_ms(), Cell::middle(ours.lengths_m), ours.refused, uniform.solved,
                    options.seeds, uniform.median_ms(), ratio);
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
                                {"ratio_to_uniform", ratio}});
        solved += ours.solved;
        ++cells;
      }
    }
  }
  json["solved"] = solved;
  json["asked"] = cells * options.seeds;
  json["cells"] = cells;
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
    else
      known = false;
  }
  if (!known || options.seeds < 1 || !(options.most_s > 0.0)) {
    std::fprintf(stderr, "usage: bench_ltl [--json FILE] [--seeds N] [--time SECONDS]\n");
    return stepwright::result::to_int(stepwright::result::ExitCode::Usage);
  }
  return stepwright::bench::run(options);
}

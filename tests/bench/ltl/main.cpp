// bench_ltl: a train plans the tasks of E. Plaku 2012 (phi1: eight places in succession, phi2 as printed:
// three of them, phi3: all of them; and phi2 in order, which the progression plans without a table) on both
// published scenes. A run is everything: triangles, automaton, search, plan checker. Baselines, in the same
// run: the same search without the guide, which looks for routes on all sides alike; OMPL's LTLPlanner and
// the paper's Algorithm 1 as printed, on the same triangles, automaton, motion and walls, with the best of
// their settings in each cell, where a plan counts if the plan checker accepts it. A run without a plan
// counts ten times its time. Each plan of ours is looked at once more by means of the benchmark's own, and
// its length beside the lower bound of a point.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"
#include "supervisor/ltl/bound/point_bound.h"
#include "supervisor/ltl/guide/task.h"
#include "supervisor/ltl/lanes/lanes.h"
#include "supervisor/ltl/planner/plan_train.h"
#include "tests/bench/ltl/automata_sizes.h"
#include "tests/bench/ltl/ltl_planner.h"
#include "tests/bench/ltl/paper_literal.h"
#include "tests/bench/ltl/plan_check.h"
#include "tests/bench/ltl/train_problem.h"
#include "tests/bench/ltl_monitor/monitor_cost.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kUniformSeeds = 3;  // of the search without the guide, most of which take all of their time

struct Options {
  const char* json_file = nullptr;
  int seeds = 3;
  double most_s = 4.0;
  int baseline_seeds = 1;   // of LTLPlanner and of the paper's, which take their time; 0: without them
  bool full = false;        // all settings of the paper's algorithm
  std::size_t threads = 0;  // of ours; 0: as many as the machine has, at most 2
  double shorten_s = 4.0;
  std::size_t shorten_rounds = std::numeric_limits<std::size_t>::max();  // of that
  bool all_lengths = false;  // shorter plans for every row, not only for phi1 on blocks
  std::string only;          // "blocks/phi1": this task on this scene; empty: all
};

double middle(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

struct Cell {
  std::vector<double> times_ms;
  std::vector<double> lengths_m;
  int solved = 0;
  int refused = 0;  // plans that the plan checker did not accept

  double median_ms() const { return middle(times_ms); }
  double worst_ms() const { return times_ms.empty() ? 0.0 : *std::ranges::max_element(times_ms); }
  void add(bool is_solved, double spent_ms, double length_m, double most_s) {
    times_ms.push_back(is_solved ? spent_ms : 10'000.0 * most_s);
    if (!is_solved) return;
    ++solved;
    lengths_m.push_back(length_m);
  }
};

// A task on a floor, with what is known of both.
struct Setting {
  std::string scene, name, task;
  ltl::Floor floor;
  std::optional<ltl::Formula> formula;
  std::optional<ltl::RegionMap> map;
  std::optional<ltl::Automaton> automaton;
  std::optional<ltl::PointBound> bound;

  double bound_m(const ltl::Problem& problem) const {
    if (!bound) return 0.0;
    const geometry::Point at = problem.start.position();
    return bound->length_m(at, automaton->next(automaton->initial, map->region(map->locate(at)).label));
  }
};

struct Totals {
  int solved = 0, asked = 0, cells = 0;
  int word_violations = 0, collision_violations = 0, tables_in_order = 0;
  std::map<std::size_t, std::vector<double>> ltlplanner;  // ratios, by trailers
  double paper_least = std::numeric_limits<double>::infinity();
  nlohmann::json lengths = nlohmann::json::object();  // of phi1 on blocks
};

struct Ours {
  Cell cell;
  std::vector<double> ratios;  // lengths beside the bound
};

void run_ours(const Setting& setting, const ltl::Problem& problem, const ltl::PlanOptions& options,
              Ours& ours, Totals& totals) {
  const auto began = Clock::now();
  const auto answer = ltl::plan_train(problem, options);
  const double spent_ms = std::chrono::duration<double, std::milli>(Clock::now() - began).count();
  ours.cell.add(answer.has_value(), spent_ms, answer ? answer->judgement.length_m : 0.0, options.most_s);
  if (!answer) return;
  ours.cell.refused += static_cast<int>(answer->tries) - 1;
  if (!setting.automaton && answer->states > 0) ++totals.tables_in_order;
  const PlanCheck check = check_plan(problem, *setting.formula, answer->plan);
  if (!check.word_holds) ++totals.word_violations;
  if (!check.clear) ++totals.collision_violations;
  if (const double bound_m = setting.bound_m(problem); bound_m > 0.0)
    ours.ratios.push_back(answer->judgement.length_m / bound_m);
}

void run_uniform(const ltl::Problem& problem, const ltl::PlanOptions& options, Cell& cell) {
  const auto began = Clock::now();
  const auto answer = ltl::plan_train(problem, options);
  const double spent_ms = std::chrono::duration<double, std::milli>(Clock::now() - began).count();
  cell.add(answer.has_value(), spent_ms, answer ? answer->judgement.length_m : 0.0, options.most_s);
}

// The best of its settings, by the medians.
template <typename Setup, typename Run>
Cell best_of(const std::vector<Setup>& settings, const Run& run) {
  Cell best;
  for (const Setup& each : settings) {
    Cell cell = run(each);
    if (best.times_ms.empty() || cell.median_ms() < best.median_ms()) best = std::move(cell);
  }
  return best;
}

Cell run_ltlplanner(const Setting& setting, std::size_t trailers, const Options& options) {
  return best_of<double>({0.02, 0.1, 0.5, 1.0}, [&](double explore_s) {
    Cell cell;
    for (int seed = 1; seed <= options.baseline_seeds; ++seed) {
      const auto at = static_cast<std::uint64_t>(seed);
      const OmplAnswer answer = plan_by_ltlplanner(train_problem(setting.floor, setting.task, trailers, at),
                                                   explore_s, options.most_s);
      const bool accepted = answer.plan && answer.judgement.accepted();
      if (answer.plan && !accepted) ++cell.refused;
      cell.add(accepted, 1e3 * answer.spent_s, accepted ? answer.plan->length_m : 0.0, options.most_s);
    }
    return cell;
  });
}

std::vector<PaperOptions> paper_settings(bool full) {
  if (!full) return {{.iterations = 50, .shortest = 0.9}, {.iterations = 200, .shortest = 0.9}};
  std::vector<PaperOptions> all;
  for (const std::size_t iterations : {50, 100, 200, 400, 800})
    for (const double shortest : {0.5, 0.8, 0.9, 1.0})
      all.push_back({.iterations = iterations, .shortest = shortest});
  return all;
}

Cell run_paper(const Setting& setting, std::size_t trailers, const Options& options) {
  return best_of(paper_settings(options.full), [&](PaperOptions each) {
    Cell cell;
    for (int seed = 1; seed <= options.baseline_seeds; ++seed) {
      each.seed = static_cast<std::uint64_t>(seed);
      each.most_s = options.most_s;
      const PaperAnswer answer =
          plan_by_paper(train_problem(setting.floor, setting.task, trailers, each.seed), each);
      cell.refused += static_cast<int>(answer.refused);
      cell.add(answer.plan.has_value(), 1e3 * answer.spent_s, answer.plan ? answer.plan->length_m : 0.0,
               options.most_s);
    }
    return cell;
  });
}

nlohmann::json run_row(const Setting& setting, std::size_t trailers, const Options& options, Totals& totals) {
  const bool has_table = setting.automaton.has_value();
  const bool is_phi1 = setting.scene == "blocks" && setting.name == "phi1";
  const bool is_measured = is_phi1 || options.all_lengths;
  Ours ours, shortened;
  Cell uniform;
  for (int seed = 1; seed <= options.seeds; ++seed) {
    const auto at = static_cast<std::uint64_t>(seed);
    const ltl::Problem problem = train_problem(setting.floor, setting.task, trailers, at);
    ltl::PlanOptions how{.seed = at, .most_s = options.most_s, .threads = options.threads};
    run_ours(setting, problem, how, ours, totals);
    if (is_measured) {
      how.shorten_s = options.shorten_s;
      how.shorten_rounds = options.shorten_rounds;
      run_ours(setting, problem, how, shortened, totals);
      how.shorten_s = 0.0;
    }
    how.guide = ltl::SearchGuide::None;
    if (has_table && seed <= kUniformSeeds) run_uniform(problem, how, uniform);
  }
  const bool with_baselines = has_table && options.baseline_seeds > 0;
  const Cell ompl = with_baselines ? run_ltlplanner(setting, trailers, options) : Cell{};
  const Cell paper = with_baselines ? run_paper(setting, trailers, options) : Cell{};
  const double median_ms = ours.cell.median_ms();
  const double uniform_ratio = uniform.median_ms() / median_ms;
  const double ompl_ratio = ompl.median_ms() / median_ms, paper_ratio = paper.median_ms() / median_ms;
  if (with_baselines) {
    totals.ltlplanner[trailers].push_back(ompl_ratio);
    totals.paper_least = std::min(totals.paper_least, paper_ratio);
  }
  if (is_phi1) {
    totals.lengths["length_ratio_n" + std::to_string(trailers)] = middle(shortened.ratios);
    totals.lengths["first_length_ratio_n" + std::to_string(trailers)] = middle(ours.ratios);
  }
  totals.solved += ours.cell.solved;
  totals.asked += options.seeds;
  ++totals.cells;
  std::printf("%-8s %-8s %3zu  %3d/%-3d %9.1f %9.1f %7.1f %6.2f %6.2f %4d  %3d/%-3d %9.1f %6.2f",
              setting.scene.c_str(), setting.name.c_str(), trailers, ours.cell.solved, options.seeds,
              median_ms, ours.cell.worst_ms(), middle(ours.cell.lengths_m), middle(ours.ratios),
              middle(shortened.ratios), ours.cell.refused, uniform.solved,
              std::min(options.seeds, kUniformSeeds), uniform.median_ms(), uniform_ratio);
  if (with_baselines)
    std::printf("  %2d/%-2d %9.1f %7.1f  %2d/%-2d %9.1f %7.1f", ompl.solved, options.baseline_seeds,
                ompl.median_ms(), ompl_ratio, paper.solved, options.baseline_seeds, paper.median_ms(),
                paper_ratio);
  std::printf("\n");
  std::fflush(stdout);
  return {{"scene", setting.scene},
          {"task", setting.name},
          {"trailers", trailers},
          {"solved", ours.cell.solved},
          {"median_ms", median_ms},
          {"worst_ms", ours.cell.worst_ms()},
          {"length_m", middle(ours.cell.lengths_m)},
          {"length_ratio", middle(ours.ratios)},
          {"shortened_length_ratio", middle(shortened.ratios)},
          {"refused", ours.cell.refused},
          {"uniform_solved", uniform.solved},
          {"uniform_median_ms", uniform.median_ms()},
          {"ratio_to_uniform", uniform_ratio},
          {"ltlplanner_solved", ompl.solved},
          {"ltlplanner_refused", ompl.refused},
          {"ltlplanner_median_ms", ompl.median_ms()},
          {"ratio_to_ltlplanner", ompl_ratio},
          {"paper_literal_solved", paper.solved},
          {"paper_literal_refused", paper.refused},
          {"paper_literal_median_ms", paper.median_ms()},
          {"ratio_to_paper_literal", paper_ratio}};
}

std::optional<Setting> setting_of(const std::string& scene, const std::string& name,
                                  const std::string& task) {
  Setting setting;
  setting.scene = scene;
  setting.name = name;
  setting.task = task;
  auto floor = published_floor(scene + ".geojson");
  if (!floor) return std::nullopt;
  setting.floor = *std::move(floor);
  std::vector<std::string> places;
  for (const ltl::Area& each : setting.floor.propositions) places.push_back(each.name);
  auto formula = ltl::parse_formula(task, name, places);
  auto map = ltl::make_regions(setting.floor);
  if (!formula || !map) return std::nullopt;
  setting.formula = *std::move(formula);
  setting.map = *std::move(map);
  if (name == "phi2_in_order") return setting;
  auto read = ltl::read_task(task, places, name, {.acceptance = ltl::Acceptance::Strong});
  if (!read) return std::nullopt;
  setting.automaton = std::move(read->automaton);
  setting.bound = ltl::PointBound::make(setting.floor, *setting.map, *setting.automaton);
  return setting;
}

int run(const Options& options) {
  seed_ompl(1);
  Totals totals;
  nlohmann::json json;
  const AutomataSizes sizes = automata_sizes();
  std::printf("automata: %zu sizes compared, %zu other than known; threads of the planner: %zu\n",
              sizes.compared, sizes.mismatches, ltl::threads_of(options.threads));
  std::printf("%-8s %-8s %3s  %7s %9s %9s %7s %6s %6s %4s  %7s %9s %6s  %5s %9s %7s  %5s %9s %7s\n", "scene",
              "task", "N", "solved", "median ms", "worst ms", "length", "/point", "short", "ref", "uniform",
              "median ms", "ratio", "OMPL", "median ms", "ratio", "paper", "median ms", "ratio");
  for (const std::string scene : {"blocks", "walls"}) {
    const std::pair<const char*, std::string> tasks[] = {{"phi1", ltl::test::in_succession(8)},
                                                         {"phi2", ltl::test::five_visits(8, false)},
                                                         {"phi3", ltl::test::coverage(8)},
                                                         {"phi2_in_order", ltl::test::five_visits(8, true)}};
    for (const auto& [name, task] : tasks) {
      if (!options.only.empty() && options.only != scene + "/" + name) continue;
      const auto setting = setting_of(scene, name, task);
      if (!setting) return result::to_int(result::ExitCode::BadInput);
      for (const std::size_t trailers : {0, 5, 10, 15})
        json["rows"].push_back(run_row(*setting, trailers, options, totals));
    }
  }
  json["monitor_us"] = most_us(monitor_cost());
  std::printf("the monitor of phi1 takes %.3f us of a scan\n", json["monitor_us"].get<double>());
  json["threads"] = ltl::threads_of(options.threads);
  json["solved"] = totals.solved;
  json["asked"] = totals.asked;
  json["cells"] = totals.cells;
  json["automata_compared"] = sizes.compared;
  json["automata_mismatches"] = sizes.mismatches;
  json["word_violations"] = totals.word_violations;
  json["collision_violations"] = totals.collision_violations;
  json["tables_in_order"] = totals.tables_in_order;
  json.update(totals.lengths);
  for (const auto& [trailers, all] : totals.ltlplanner) {
    json["ratio_to_ltlplanner_n" + std::to_string(trailers)] = middle(all);
    std::printf("%zu trailers: LTLPlanner takes %.1f times as long (median of the cells)\n", trailers,
                middle(all));
  }
  if (!totals.ltlplanner.empty()) {
    json["ratio_to_paper_literal_min"] = totals.paper_least;
    std::printf("Algorithm 1 as printed takes %.1f times as long in the cell where it is best\n",
                totals.paper_least);
  }
  std::printf("solved %d of %d; words that do not hold: %d, collisions: %d, tables of phi2 in order: %d\n",
              totals.solved, totals.asked, totals.word_violations, totals.collision_violations,
              totals.tables_in_order);
  if (options.json_file != nullptr) {
    std::ofstream file(options.json_file);
    file << json.dump(2) << "\n";
    if (!file) return result::to_int(result::ExitCode::BadInput);
  }
  const bool sound = sizes.mismatches == 0 && totals.word_violations == 0 &&
                     totals.collision_violations == 0 && totals.tables_in_order == 0;
  return result::to_int(sound ? result::ExitCode::Done : result::ExitCode::RuntimeFault);
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  stepwright::bench::Options options;
  bool known = true;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--full") == 0) {
      options.full = true;
      options.seeds = 30;
      options.most_s = 10.0;
      continue;
    }
    if (std::strcmp(argv[k], "--all-lengths") == 0) {
      options.all_lengths = true;
      continue;
    }
    const auto is = [&](const char* option) { return k + 1 < argc && std::strcmp(argv[k], option) == 0; };
    if (is("--json"))
      options.json_file = argv[k + 1];
    else if (is("--seeds"))
      options.seeds = std::atoi(argv[k + 1]);
    else if (is("--time"))
      options.most_s = std::atof(argv[k + 1]);
    else if (is("--threads"))
      options.threads = static_cast<std::size_t>(std::max(0, std::atoi(argv[k + 1])));
    else if (is("--shorten"))
      options.shorten_s = std::atof(argv[k + 1]);
    else if (is("--shorten-rounds"))
      options.shorten_rounds = static_cast<std::size_t>(std::max(0, std::atoi(argv[k + 1])));
    else if (is("--only"))
      options.only = argv[k + 1];
    else if (is("--baseline-seeds") || is("--ompl-seeds"))
      options.baseline_seeds = std::atoi(argv[k + 1]);
    else
      known = false;
    ++k;
  }
  if (!known || options.seeds < 1 || !(options.most_s > 0.0) || options.baseline_seeds < 0) {
    std::fprintf(stderr,
                 "usage: bench_ltl [--full] [--json FILE] [--seeds N] [--time SECONDS] [--baseline-seeds N] "
                 "[--threads "
                 "N] [--shorten SECONDS] [--shorten-rounds N] [--all-lengths] [--only SCENE/TASK]\n");
    return stepwright::result::to_int(stepwright::result::ExitCode::Usage);
  }
  return stepwright::bench::run(options);
}

// bench_reach: the two experiments of F. Lagriffoul, L. Karlsson, A. Saffiotti 2012 as seeded problems for
// two arms whose numbers are published (tests/support/tamp/experiments.cpp). Baselines, in the same process,
// on the same instances, tables and checks: SearchAndFilter with FilterDomain as printed (Clp, warm) and
// depth-first search, both with the best of four orders. A check is the exact reach at a point: there are no
// obstacles and no motion planner, whose time (the paper: 0.1 s for each configuration) would come on top for
// all of them. Then: refutations timed and confirmed, causes of cells in which one number was moved, poses
// beside bounds.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"
#include "supervisor/motion/kinematics/srs_arm.h"
#include "supervisor/motion/robot/urdf_reader.h"
#include "supervisor/tamp/intervals/arm/srs_reach.h"
#include "supervisor/tamp/intervals/cause/cause.h"
#include "supervisor/tamp/intervals/cause/reached.h"
#include "supervisor/tamp/intervals/cause/witness.h"
#include "supervisor/tamp/intervals/network/network.h"
#include "supervisor/tamp/intervals/search/sequence_search.h"
#include "tests/bench/reach/paper_search.h"
#include "tests/support/tamp/certificate_check.h"
#include "tests/support/tamp/experiments.h"
#include "tests/support/tamp/moved_cells.h"

namespace stepwright::bench {
namespace {

using tamp::Answer;
using tamp::Network;
using tamp::SearchOutcome;
using tamp::testing::Problem;
using tamp::testing::TwoArms;

struct Options {
  const char* json_file = nullptr;
  int runs = 100;
  int poses = 1'000'000;
  double cell_m = 0.02;
  bool with_baselines = true;
};

double now_us() {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double percentile(std::vector<double> values, double part) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(part * static_cast<double>(values.size())))];
}
double median(const std::vector<double>& values) {
  return percentile(values, 0.5);
}

// Of the processor: what else the machine does costs nothing.
double processor_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// The shortest of some repetitions, in microseconds.
template <typename Work>
double time_us(int repetitions, const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repetitions; ++k) {
    const double began = now_us();
    work();
    least = std::min(least, now_us() - began);
  }
  return least;
}

tamp::Checker checker(const TwoArms& arms) {
  return [&arms](std::span<const tamp::Configuration> chain) {
    const tamp::Configuration& last = chain.back();
    return arcs_at(arms.model(last.arm), last.tool).contains(last.tool_angle) ? tamp::Check::Passed
                                                                              : tamp::Check::Never;
  };
}

struct Run {
  bool solved = false, refuted = false;
  double time_us = 0.0;
  double configurations = 0.0;
};

struct Baseline {
  std::string name;
  std::vector<Run> runs;

  double median_us() const {
    std::vector<double> times;
    for (const Run& run : runs) times.push_back(run.time_us);
    return percentile(times, 0.5);
  }
  double total_us() const {
    double sum = 0.0;
    for (const Run& run : runs) sum += run.time_us;
    return sum;
  }
};

struct Totals {
  double most_configurations = 0.0;
  int solved = 0, asked = 0, lost = 0;  // lost: a baseline solved what we did not
  int unsound = 0;
  std::vector<double> refutation_us;
  std::vector<double> saf_ratios, dfs_ratios;  // of the hardest tenth
};

// Refutes a prefix again and again on a network that stands before its last action.
void time_refutation(const Problem& problem, Totals& totals) {
  Network network(problem.cell);
  std::size_t k = 0;
  while (k < problem.sequence.size() && network.push(problem.sequence[k])) ++k;
  if (!network.refuted()) return;
  if (const std::string wrong = tamp::testing::wrong_with(network, network.certificate()); !wrong.empty()) {
    ++totals.unsound;
    std::printf("a certificate is wrong: %s\n", wrong.c_str());
  }
  // All of it, from nothing.
  totals.refutation_us.push_back(time_us(5, [&] {
    Network whole(problem.cell);
    for (const tamp::Action& action : problem.sequence)
      if (!whole.push(action)) break;
  }));
}

template <typename Search>
Baseline best_order(const std::vector<Problem>& problems, const char* name, const Search& search) {
  Baseline best;
  for (const Order order : kOrders) {
    Baseline one{std::string(name) + " " + name_of(order), {}};
    for (const Problem& problem : problems) {
      const double began = now_us();
      const PaperAnswer answer = search(problem, order);
      one.runs.push_back({answer.outcome == SearchOutcome::Solved, answer.refuted, now_us() - began,
                          static_cast<double>(answer.configurations)});
    }
    std::printf("  %-20s median %10.1f us, total %8.2f s\n", one.name.c_str(), one.median_us(),
                one.total_us() * 1e-6);
    std::fflush(stdout);
    if (best.runs.empty() || one.total_us() < best.total_us()) best = std::move(one);
  }
  return best;
}

nlohmann::json experiment(int number, const TwoArms& arms, const Options& options, Totals& totals) {
  std::vector<Problem> problems;
  for (int seed = 1; seed <= options.runs; ++seed)
    problems.push_back(number == 1 ? tamp::testing::experiment_1(arms, static_cast<std::uint64_t>(seed))
                                   : tamp::testing::experiment_2(arms, static_cast<std::uint64_t>(seed)));
  const tamp::Checker check = checker(arms);
  std::vector<Run> ours;
  for (const Problem& problem : problems) {
    tamp::SearchAnswer answer;
    const double spent = time_us(
        3, [&] { answer = tamp::search_sequence(problem.cell, problem.sequence, problem.how, check); });
    ours.push_back({answer.outcome == SearchOutcome::Solved, answer.refuted, spent,
                    static_cast<double>(answer.configurations)});
    if (answer.refuted) time_refutation(problem, totals);
  }
  double most = 0.0;
  int solved = 0, refuted = 0;
  std::vector<double> times;
  for (const Run& run : ours) {
    if (run.solved) most = std::max(most, run.configurations);
    solved += run.solved;
    refuted += run.refuted;
    times.push_back(run.time_us);
  }
  totals.most_configurations = std::max(totals.most_configurations, most);
  totals.solved += solved;
  totals.asked += options.runs;
  std::printf("experiment %d: %d solved, %d refuted of %d; at most %.0f configurations; median %.1f us\n",
              number, solved, refuted, options.runs, most, median(times));
  nlohmann::json json = {{"solved", solved},
                         {"refuted", refuted},
                         {"max_configurations", most},
                         {"median_us", median(times)},
                         {"p99_us", percentile(times, 0.99)}};
  if (!options.with_baselines) return json;
  const Baseline saf = best_order(problems, "SAF", [&](const Problem& problem, Order order) {
    return search_and_filter(problem.cell, problem.sequence, problem.how, check, order, 1e-3);
  });
  const Baseline dfs = best_order(problems, "DFS", [&](const Problem& problem, Order order) {
    return depth_first(problem.cell, problem.sequence, problem.how, check, order);
  });
  // The hardest tenth of what is feasible, by the configurations of DFS.
  std::vector<std::size_t> by_hardness;
  for (std::size_t k = 0; k < problems.size(); ++k)
    if (ours[k].solved) by_hardness.push_back(k);
  std::ranges::stable_sort(by_hardness, std::ranges::greater{},
                           [&](std::size_t k) { return dfs.runs[k].configurations; });
  by_hardness.resize(std::max<std::size_t>(1, by_hardness.size() / 10));
  std::vector<double> saf_all, saf_hard, dfs_hard, dfs_paths, saf_configurations, dfs_configurations;
  for (std::size_t k = 0; k < problems.size(); ++k) {
    saf_all.push_back(saf.runs[k].time_us / ours[k].time_us);
    if (ours[k].solved && saf.runs[k].solved) saf_configurations.push_back(saf.runs[k].configurations);
    if (ours[k].solved && dfs.runs[k].solved) dfs_configurations.push_back(dfs.runs[k].configurations);
    if (!ours[k].solved && (saf.runs[k].solved || dfs.runs[k].solved)) ++totals.lost;
    if (ours[k].refuted && (saf.runs[k].solved || dfs.runs[k].solved)) ++totals.unsound;
  }
  for (const std::size_t k : by_hardness) {
    saf_hard.push_back(saf.runs[k].time_us / ours[k].time_us);
    dfs_hard.push_back(dfs.runs[k].time_us / ours[k].time_us);
    // As if a path were planned for each configuration, in the paper's 0.1 s.
    const auto with_paths = [](const Run& run) { return run.time_us + 1e5 * run.configurations; };
    dfs_paths.push_back(with_paths(dfs.runs[k]) / with_paths(ours[k]));
  }
  int saf_solved = 0, dfs_solved = 0;
  for (const Run& run : saf.runs) saf_solved += run.solved;
  for (const Run& run : dfs.runs) dfs_solved += run.solved;
  std::printf(
      "  SAF solved %d, at most %.0f configurations, %.1f times our time (median), hardest tenth %.1f\n",
      saf_solved, percentile(saf_configurations, 1.0), median(saf_all), median(saf_hard));
  std::printf(
      "  DFS solved %d, at most %.0f configurations; hardest tenth %.1f times our time, with paths of 0.1 s "
      "%.0f "
      "times\n",
      dfs_solved, percentile(dfs_configurations, 1.0), median(dfs_hard), median(dfs_paths));
  totals.saf_ratios.push_back(median(saf_all));
  totals.dfs_ratios.push_back(median(dfs_paths));
  json.update({{"saf", saf.name},
               {"saf_solved", saf_solved},
               {"saf_median_us", saf.median_us()},
               {"saf_max_configurations", percentile(saf_configurations, 1.0)},
               {"ratio_to_saf", median(saf_all)},
               {"ratio_to_saf_hardest_tenth", median(saf_hard)},
               {"dfs", dfs.name},
               {"dfs_solved", dfs_solved},
               {"dfs_median_us", dfs.median_us()},
               {"dfs_max_configurations", percentile(dfs_configurations, 1.0)},
               {"ratio_to_dfs_hardest_tenth", median(dfs_hard)},
               {"ratio_to_dfs_hardest_tenth_with_paths", median(dfs_paths)}});
  return json;
}

// Refutations of cells in which one number was moved, their causes and what is suggested.
nlohmann::json causes(const TwoArms& arms, int count, Totals& totals) {
  int wrong = 0, proved = 0;
  std::vector<double> times_us;
  const tamp::ColumnReach of_right(arms.right), of_left(arms.left);
  for (int seed = 1; seed <= count; ++seed) {
    tamp::testing::MovedCell moved = tamp::testing::moved_cell(arms, static_cast<std::uint64_t>(seed));
    time_refutation(moved.problem, totals);
    moved.problem.cell.arms[0].exact = &of_right;
    moved.problem.cell.arms[1].exact = &of_left;
    const double began = now_us();
    const auto cause = tamp::explain(moved.problem.cell, moved.problem.sequence);
    times_us.push_back(now_us() - began);
    bool right = cause && cause->irreducible &&
                 std::ranges::any_of(cause->constraints, [&](const tamp::Constraint& each) {
                   return tamp::testing::fixes(each, moved);
                 });
    bool helps = false;
    for (std::size_t k = 0; right && k < cause->suggestions.size(); ++k) {
      const tamp::Suggestion& each = cause->suggestions[k];
      tamp::WorkCell cell = moved.problem.cell;
      std::vector<tamp::Action> sequence = moved.problem.sequence;
      apply(each, cell, sequence);
      right = each.proved ? tamp::reached(cell, sequence).has_value()
                          : tamp::solve(cell, sequence).answer == Answer::Feasible;
      proved += each.proved ? 1 : 0;
      helps = helps || (each.parameter == moved.parameter && each.subject == moved.subject);
    }
    if (!right || !helps) ++wrong;
  }
  std::printf("causes: %d wrong of %d, %d values proved, median %.0f us\n", wrong, count, proved,
              median(times_us));
  return {{"asked", count}, {"wrong", wrong}, {"proved", proved}, {"median_us", median(times_us)}};
}

int poses_outside(const TwoArms& arms, int count) {
  tamp::testing::Random random(3);
  int outside = 0;
  for (int reachable = 0; reachable < count;) {
    const std::size_t arm = random.below(2);
    const tamp::Point3 at{tamp::nanometres_of(random.from_to(-0.85, 0.85)),
                          tamp::nanometres_of(random.from_to(-1.1, 1.1)),
                          tamp::nanometres_of(random.from_to(-0.3, 1.4))};
    const tamp::ArcSet exact = arcs_at(arms.model(arm), at);
    if (exact.empty()) continue;
    ++reachable;
    tamp::ArcSet bounds;
    bounds.add((arm == 0 ? arms.right_table : arms.left_table).arcs_at(at));
    for (const tamp::Arc arc : exact.arcs())
      if (!bounds.contains(arc)) ++outside;
  }
  return outside;
}

// The maps of the tree's own two arms, and poses of a tool that hangs down beside their bounds: whether a
// pose is reached is told by the exact arcs of the elbow's swivel.
nlohmann::json arm_maps(const Options& options, int poses, Totals& totals) {
  std::ifstream in(STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell/two_arms.urdf", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto robot = motion::read_urdf(text, "two_arms.urdf");
  if (!robot) return {};
  double map_s = 0.0;
  std::size_t cells = 0;
  int reached = 0, outside = 0, bounded = 0;
  tamp::testing::Random random(5);
  for (const char* tip : {"left_tcp", "right_tcp"}) {
    const auto chain = motion::Chain::between(*robot, robot->link("torso"), robot->link(tip));
    const auto arm = motion::SrsArm::recognise(*chain);
    const auto reach = tamp::SrsReach::make(*chain);
    const double began_s = processor_s();
    const tamp::ReachTable table = reach->table(options.cell_m);
    map_s += processor_s() - began_s;
    cells += table.grid().size();
    for (int k = 0; k < poses / 2; ++k) {
      const auto along = [&](std::size_t axis) {
        const tamp::Span extent = table.grid().extent(axis);
        return random.from_to(tamp::metres_of(extent.low_nm), tamp::metres_of(extent.high_nm));
      };
      const motion::Vector3 at{along(0), along(1), along(2)};
      const double angle = random.from_to(-3.14159, 3.14159), c = std::cos(angle), s = std::sin(angle);
      const motion::Transform tool{motion::from_columns({c, s, 0}, {s, -c, 0}, {0, 0, -1}), at};
      tamp::ArcSet bounds;
      bounds.add(
          table.arcs_at({tamp::nanometres_of(at.x), tamp::nanometres_of(at.y), tamp::nanometres_of(at.z)}));
      const bool within = bounds.contains(tamp::angle_of(angle)), is = !arm->arcs(tool).empty();
      bounded += within;
      reached += is;
      outside += is && !within;
    }
  }
  totals.unsound += outside;
  std::printf(
      "maps of two arms from their URDF at %.0f mm: %.1f s, %zu cells; of %d poses %d are reached, %d within "
      "the bounds, %d outside of them though reached\n",
      1e3 * options.cell_m, map_s, cells, poses, reached, bounded, outside);
  return {{"map_s", map_s},     {"cells", cells},     {"poses", poses},
          {"reached", reached}, {"bounded", bounded}, {"outside", outside}};
}

// A push of a place and its pop, beside all of the sequence anew.
nlohmann::json increments(const TwoArms& arms) {
  std::vector<double> push_us, anew_us, passes;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Problem problem = tamp::testing::experiment_1(arms, seed);
    Network network(problem.cell);
    for (std::size_t k = 0; k + 1 < problem.sequence.size(); ++k) network.push(problem.sequence[k]);
    if (network.refuted()) continue;
    const std::size_t before = network.passes();
    const double one = time_us(5, [&] {
      network.push(problem.sequence.back());
      network.pop();
    });
    passes.push_back(static_cast<double>(network.passes() - before) / 5.0);
    push_us.push_back(one);
    anew_us.push_back(time_us(5, [&] {
      Network again(problem.cell);
      for (const tamp::Action& action : problem.sequence) again.push(action);
    }));
  }
  std::printf("push and pop of a place: median %.1f us (%.1f spots filtered); the sequence anew %.1f us\n",
              median(push_us), median(passes), median(anew_us));
  return {{"push_pop_us", median(push_us)}, {"spots_filtered", median(passes)}, {"anew_us", median(anew_us)}};
}

int run(const Options& options) {
  const double began_s = processor_s();
  const TwoArms arms = tamp::testing::two_arms(options.cell_m);
  const double map_s = processor_s() - began_s;
  std::printf("two maps of %.0f mm in %.2f s: %zu cells\n", 1e3 * options.cell_m, map_s,
              2 * arms.right_table.grid().size());
  Totals totals;
  nlohmann::json json = {{"map_s", map_s}};
  json["experiment_1"] = experiment(1, arms, options, totals);
  json["experiment_2"] = experiment(2, arms, options, totals);
  json["causes"] = causes(arms, 2 * options.runs, totals);
  json["increments"] = increments(arms);
  json["arm_maps"] = arm_maps(options, std::min(options.poses, 200'000), totals);
  const int outside = poses_outside(arms, options.poses);
  json["reach_max_configurations"] = totals.most_configurations;
  json["reach_infeasible_us"] = median(totals.refutation_us);
  json["reach_infeasible_p99_us"] = percentile(totals.refutation_us, 0.99);
  json["reach_infeasible_asked"] = totals.refutation_us.size();
  json["reach_unsound"] = totals.unsound + outside;
  json["reach_wrong_causes"] = json["causes"]["wrong"];
  json["reach_lost"] = totals.lost;
  if (!totals.saf_ratios.empty()) {
    json["reach_ratio_to_saf"] = *std::ranges::min_element(totals.saf_ratios);
    json["reach_ratio_to_dfs"] = *std::ranges::min_element(totals.dfs_ratios);
  }
  std::printf(
      "refuted in %.1f us (median of %zu; p99 %.1f us); unsound: %d; poses outside of the bounds: %d of %d\n",
      median(totals.refutation_us), totals.refutation_us.size(), percentile(totals.refutation_us, 0.99),
      totals.unsound, outside, options.poses);
  if (options.json_file != nullptr) {
    std::ofstream file(options.json_file);
    file << json.dump(2) << "\n";
    if (!file) return result::to_int(result::ExitCode::BadInput);
  }
  const bool sound =
      totals.unsound == 0 && outside == 0 && totals.lost == 0 && json["reach_wrong_causes"] == 0;
  return result::to_int(sound ? result::ExitCode::Done : result::ExitCode::RuntimeFault);
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  stepwright::bench::Options options;
  bool known = true;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--no-baselines") == 0) {
      options.with_baselines = false;
      continue;
    }
    const auto is = [&](const char* option) { return k + 1 < argc && std::strcmp(argv[k], option) == 0; };
    if (is("--json"))
      options.json_file = argv[k + 1];
    else if (is("--runs"))
      options.runs = std::atoi(argv[k + 1]);
    else if (is("--poses"))
      options.poses = std::atoi(argv[k + 1]);
    else if (is("--cell"))
      options.cell_m = std::atof(argv[k + 1]);
    else
      known = false;
    ++k;
  }
  if (!known || options.runs < 1 || options.poses < 0 ||
      !(options.cell_m >= 0.005 && options.cell_m <= 0.2)) {
    std::fprintf(
        stderr, "usage: bench_reach [--json FILE] [--runs N] [--poses N] [--cell METRES] [--no-baselines]\n");
    return stepwright::result::to_int(stepwright::result::ExitCode::Usage);
  }
  return stepwright::bench::run(options);
}

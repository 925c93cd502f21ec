// The allocation of transports beside two rules of thumb: the nearest vehicle, and plain insertion.
//
//   bench_allocation [--most N] [--seeds N] [--rounds N] [--exact N] [--cpu-time] [--json FILE]
//
// First what is proved: 8 transports for 4 vehicles. Then 10 to 200 transports with so many rounds each, so
// that the objectives do not depend on the machine; that of each rule is told as a ratio to ours. Every
// answer is judged by the checker of the tests.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"
#include "supervisor/fleet/allocation/allocate.h"
#include "tests/bench/allocation/baselines.h"
#include "tests/support/fleet/allocation_checker.h"
#include "tests/support/fleet/drawn_transports.h"

namespace stepwright::bench::allocation {
namespace {

using fleet::AllocationAnswer;
using fleet::AllocationProblem;
using fleet::AllocationVerdict;

struct Arguments {
  std::uint32_t most = 200;
  std::uint32_t seeds = 3;
  std::uint64_t rounds = 3000;
  std::uint32_t exact = 25;
  bool cpu_time = false;
  std::string json_file;
};

class Watch {
 public:
  explicit Watch(bool cpu_time) : cpu_time_(cpu_time), begin_ms_(now_ms()) {}
  double ms() const { return now_ms() - begin_ms_; }

 private:
  double now_ms() const {
    std::timespec now{};
    clock_gettime(cpu_time_ ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
  }
  bool cpu_time_;
  double begin_ms_;
};

struct Mean {
  double sum = 0.0;
  std::uint32_t count = 0;
  void add(double value) {
    sum += value;
    ++count;
  }
  double value() const { return count == 0 ? 0.0 : sum / count; }
  std::string ratio() const {
    char text[32] = "none";
    if (count > 0) std::snprintf(text, sizeof text, "%.2f", value());
    return text;
  }
};

class Bench {
 public:
  explicit Bench(const Arguments& arguments) : arguments_(arguments) {}

  int run() {
    exact();
    std::printf("%-8s %10s %8s | %10s %10s %8s | %9s %9s | %9s %9s\n", "kind", "transports", "vehicles",
                "objective", "to bound", "ms", "nearest", "ms", "insertion", "ms");
    for (const support::TransportKind kind : support::kTransportKinds) {
      for (const std::uint32_t transports : {10U, 20U, 50U, 100U, 200U}) {
        if (transports <= arguments_.most) row(kind, transports);
      }
    }
    json_["ratio_nearest"] = nearest_.value();
    json_["ratio_insertion"] = insertion_.value();
    json_["checker_faults"] = faults_;
    std::printf("mean ratios: nearest vehicle %.2f, plain insertion %.2f; faults %u\n", nearest_.value(),
                insertion_.value(), faults_);
    if (!arguments_.json_file.empty()) std::ofstream(arguments_.json_file) << json_.dump(2) << "\n";
    return to_int(faults_ == 0 ? result::ExitCode::Done : result::ExitCode::RuntimeFault);
  }

 private:
  bool sound(const AllocationAnswer& answer, const AllocationProblem& problem) {
    const bool found =
        answer.verdict == AllocationVerdict::Optimal || answer.verdict == AllocationVerdict::Feasible;
    if (!found) return false;
    const auto faults = fleet::faults_of(answer, problem);
    for (const std::string& fault : faults) std::fprintf(stderr, "bench_allocation: %s\n", fault.c_str());
    faults_ += static_cast<std::uint32_t>(faults.size());
    return faults.empty();
  }

  void exact() {
    for (const support::TransportKind kind : support::kTransportKinds) {
      std::vector<double> times_ms;
      std::uint32_t proved = 0;
      Mean nodes;
      for (std::uint32_t seed = 1; seed <= arguments_.exact; ++seed) {
        const AllocationProblem problem = support::draw_transports(kind, 8, 4, seed);
        const Watch watch(arguments_.cpu_time);
        const AllocationAnswer answer =
            allocate(problem, {.time = std::chrono::seconds(20), .iterations = 500});
        times_ms.push_back(watch.ms());
        nodes.add(static_cast<double>(answer.figures.nodes));
        if (answer.verdict == AllocationVerdict::Infeasible) ++proved;
        if (!sound(answer, problem)) continue;
        if (answer.verdict == AllocationVerdict::Optimal) ++proved;
      }
      if (times_ms.empty()) return;
      std::ranges::sort(times_ms);
      const double median_ms = times_ms[times_ms.size() / 2], worst_ms = times_ms.back();
      std::printf(
          "8 transports, 4 vehicles, %-8s %u of %u proved, median %.1f ms, worst %.1f ms, %.0f nodes\n",
          support::name_of(kind).c_str(), proved, arguments_.exact, median_ms, worst_ms, nodes.value());
      json_["exact"].push_back({{"kind", support::name_of(kind)},
                                {"instances", arguments_.exact},
                                {"proved", proved},
                                {"median_ms", median_ms},
                                {"max_ms", worst_ms}});
    }
  }

  // The ratio of a rule's objective to ours, if it has kept the constraints.
  double ratio(const std::optional<AllocationAnswer>& rule, const AllocationAnswer& ours, Mean& mean) {
    if (!rule) return 0.0;
    const double ratio = static_cast<double>(rule->objective) / static_cast<double>(ours.objective);
    mean.add(ratio);
    return ratio;
  }

  void row(support::TransportKind kind, std::uint32_t transports) {
    const std::uint32_t vehicles = std::max(3U, transports / 10);
    Mean objective, to_bound, ms, nearest_ms, insertion_ms, nearest, insertion;
    for (std::uint32_t seed = 1; seed <= arguments_.seeds; ++seed) {
      const AllocationProblem problem =
          support::draw_transports(kind, transports, vehicles, 1000 * transports + seed);
      const Watch watch(arguments_.cpu_time);
      const AllocationAnswer ours = allocate(problem, {.iterations = arguments_.rounds});
      ms.add(watch.ms());
      const Watch nearest_watch(arguments_.cpu_time);
      const auto by_nearest = nearest_vehicle(problem);
      nearest_ms.add(nearest_watch.ms());
      const Watch insertion_watch(arguments_.cpu_time);
      const auto by_insertion = plain_insertion(problem);
      insertion_ms.add(insertion_watch.ms());
      if (!sound(ours, problem)) continue;
      objective.add(static_cast<double>(ours.objective));
      to_bound.add(static_cast<double>(ours.objective) /
                   static_cast<double>(std::max<std::int64_t>(1, ours.lower_bound)));
      ratio(by_nearest, ours, nearest);
      ratio(by_insertion, ours, insertion);
    }
    std::printf("%-8s %10u %8u | %10.4g %10.3f %8.1f | %9s %9.2f | %9s %9.2f\n",
                support::name_of(kind).c_str(), transports, vehicles, objective.value(), to_bound.value(),
                ms.value(), nearest.ratio().c_str(), nearest_ms.value(), insertion.ratio().c_str(),
                insertion_ms.value());
    std::fflush(stdout);
    json_["rows"].push_back({{"kind", support::name_of(kind)},
                             {"transports", transports},
                             {"vehicles", vehicles},
                             {"found", objective.count},
                             {"objective", objective.value()},
                             {"ratio_to_bound", to_bound.value()},
                             {"wall_ms", ms.value()},
                             {"ratio_nearest", nearest.value()},
                             {"nearest_found", nearest.count},
                             {"nearest_ms", nearest_ms.value()},
                             {"ratio_insertion", insertion.value()},
                             {"insertion_found", insertion.count},
                             {"insertion_ms", insertion_ms.value()}});
    nearest_.sum += nearest.sum;
    nearest_.count += nearest.count;
    insertion_.sum += insertion.sum;
    insertion_.count += insertion.count;
  }

  const Arguments& arguments_;
  nlohmann::json json_;
  Mean nearest_, insertion_;
  std::uint32_t faults_ = 0;
};

}  // namespace
}  // namespace stepwright::bench::allocation

int main(int argc, char** argv) {
  using namespace stepwright::bench::allocation;
  Arguments arguments;
  CLI::App app("the allocation of transports beside rules of thumb", "bench_allocation");
  app.add_option("--most", arguments.most, "transports")->check(CLI::Range(10, 200));
  app.add_option("--seeds", arguments.seeds, "problems of each kind and size")->check(CLI::Range(1, 1000));
  app.add_option("--rounds", arguments.rounds, "of large neighbourhood search")
      ->check(CLI::Range(1, 10000000));
  app.add_option("--exact", arguments.exact, "problems of each kind to prove")->check(CLI::Range(0, 10000));
  app.add_flag("--cpu-time", arguments.cpu_time, "CPU time of the thread instead of wall time");
  app.add_option("--json", arguments.json_file);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : to_int(stepwright::result::ExitCode::Usage);
  }
  return Bench(arguments).run();
}

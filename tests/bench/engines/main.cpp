// The two engines beside C: 1000 rungs, an arithmetic loop and 300 function blocks, each with new random
// inputs in every scan, in both engines, in the manner of matiec and as hand-written C (gcc -O2, in the same
// run, taking turns). Then the growth of the rungs to 100,000 beside the same C, and how long compiling
// takes. First the tank bench's plan with and without its monitors. All results are compared before anything
// is timed.
//
//   bench_engines [--json FILE]

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/native/native_engine.h"
#include "tests/bench/engines/baseline.h"
#include "tests/bench/engines/monitored_plan.h"
#include "tests/bench/engines/st_program.h"
#include "tests/bench/engines/workload.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t kIntervalNs = 10'000'000;
constexpr int kComparedScans = 100;
constexpr int kTimedScans = 4001;
constexpr int kComparedGrowthScans = 10;
constexpr int kTimedGrowthScans = 201;

double since_us(Clock::time_point start) {
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// What two readings of the clock alone take.
double clock_us() {
  std::vector<double> times(1001);
  for (double& time : times) time = since_us(Clock::now());
  return median(times);
}

// New values in every scan, so that no branch predictor learns them.
class Inputs {
 public:
  explicit Inputs(const Workload& workload) : bools(workload.bools.size()), reals(workload.reals.size()) {}
  void next() {
    for (std::uint8_t& value : bools) value = random_() >> 5 & 1;
    for (float& value : reals) value = static_cast<float>(random_() % 1000) * 0.1f;
  }
  std::vector<std::uint8_t> bools;
  std::vector<float> reals;

 private:
  std::mt19937 random_{1};
};

struct Contestant {
  const char* name;
  std::unique_ptr<Subject> subject;
  double tolerance;  // relative; matiec's manner computes in double here and there
  std::vector<double> times_us;
};

void compare(const Workload& workload, std::vector<Contestant>& contestants, Inputs& inputs, int scans) {
  for (int scan = 0; scan < scans; ++scan) {
    inputs.next();
    std::vector<double> expected;
    for (Contestant& contestant : contestants) {
      contestant.subject->set(inputs.bools, inputs.reals);
      contestant.subject->scan(scan * kIntervalNs);
      const std::vector<double> results = contestant.subject->results();
      if (expected.empty()) expected = results;
      for (std::size_t i = 0; i < results.size(); ++i) {
        const double allowed = contestant.tolerance * (1 + std::abs(expected[i]));
        if (std::abs(results[i] - expected[i]) <= allowed) continue;
        throw std::runtime_error(workload.results[i] + " differs in " + contestant.name + ", scan " +
                                 std::to_string(scan) + ": " + std::to_string(results[i]) + " instead of " +
                                 std::to_string(expected[i]));
      }
    }
  }
}

enum class Change { EveryScan, Never };

void time(std::vector<Contestant>& contestants, Inputs& inputs, int scans,
          Change change = Change::EveryScan) {
  const double overhead = clock_us();
  for (Contestant& contestant : contestants) contestant.times_us.clear();
  for (int scan = 0; scan < scans; ++scan) {
    if (change == Change::EveryScan) inputs.next();
    for (Contestant& contestant : contestants) {
      contestant.subject->set(inputs.bools, inputs.reals);
      const auto start = Clock::now();
      contestant.subject->scan((kComparedScans + scan) * kIntervalNs);
      contestant.times_us.push_back(std::max(0.0, since_us(start) - overhead));
    }
  }
}

void run_workload(const Workload& workload, nlohmann::json& out) {
  std::vector<Contestant> contestants;
  const std::size_t results = workload.results.size();
  contestants.push_back({"native", std::make_unique<StProgram>(workload, EngineKind::Native), 0, {}});
  contestants.push_back({"vm", std::make_unique<StProgram>(workload, EngineKind::Vm), 0, {}});
  contestants.push_back({"matiec_style", compile_c(workload.matiec_style_c, results), 1e-3, {}});
  contestants.push_back({"hand", compile_c(workload.hand_c, results), 0, {}});
  Inputs inputs(workload);
  compare(workload, contestants, inputs, kComparedScans);
  time(contestants, inputs, kTimedScans);
  std::printf("%-7s", workload.name.c_str());
  double native = 0;
  for (Contestant& contestant : contestants) {
    const double us = median(contestant.times_us);
    if (native == 0) native = us;
    out[workload.name + "_" + contestant.name + "_us"] = us;
    std::printf("  %s %.3f us (native = %.2f of it)", contestant.name, us, native / us);
  }
  // A scan costs what the program costs, whatever its inputs are.
  time(contestants, inputs, kTimedScans, Change::Never);
  std::printf("\n        the same inputs in every scan:");
  for (Contestant& contestant : contestants) {
    const double us = median(contestant.times_us);
    out[workload.name + "_" + contestant.name + "_constant_inputs_us"] = us;
    std::printf("  %s %.3f us", contestant.name, us);
  }
  std::printf("\n");
  std::fflush(stdout);
}

// Source to a native engine that could run.
double compile_ms(const std::string& st, int repeats) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    const auto start = Clock::now();
    const reader::LoadedProgram loaded = compile_st(st);
    const auto engine = native::NativeEngine::compile(loaded.program());
    if (!engine) throw std::runtime_error(result::to_string(engine.error()));
    times.push_back(since_us(start) / 1000);
  }
  return median(times);
}

double native_only_ms(const reader::LoadedProgram& loaded, int repeats) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    const auto start = Clock::now();
    const auto engine = native::NativeEngine::compile(loaded.program());
    times.push_back(since_us(start) / 1000);
  }
  return median(times);
}

void run_growth(std::uint32_t count, int repeats, nlohmann::json& out) {
  const Workload workload = rungs(count);
  Inputs inputs(workload);
  std::vector<Contestant> contestants;
  contestants.push_back({"native", std::make_unique<StProgram>(workload, EngineKind::Native), 0, {}});
  contestants.push_back({"hand", compile_c(workload.hand_c, workload.results.size()), 0, {}});
  compare(workload, contestants, inputs, kComparedGrowthScans);
  time(contestants, inputs, kTimedGrowthScans);
  const std::string name = std::to_string(count) + "_rungs";
  const double scan_us = median(contestants[0].times_us);
  const double hand_us = median(contestants[1].times_us);
  const double all_ms = compile_ms(workload.st, repeats);
  const double native_ms = native_only_ms(compile_st(workload.st), repeats);
  out["compile_" + name + "_ms"] = all_ms;
  out["native_code_" + name + "_ms"] = native_ms;
  out["native_" + name + "_us"] = scan_us;
  out["hand_" + name + "_us"] = hand_us;
  std::printf(
      "%6u rungs: native %.2f us a scan (%.3f ns a rung), hand %.2f us (%.3f ns a rung); compiled in %.1f "
      "ms, "
      "of it %.2f ms native code\n",
      count, scan_us, scan_us * 1000 / count, hand_us, hand_us * 1000 / count, all_ms, native_ms);
}

// What the supervisor's monitors add to every scan of the tank bench's plan.
void run_monitors(nlohmann::json& out) {
  for (const auto& [name, kind] :
       {std::pair("native", EngineKind::Native), std::pair("vm", EngineKind::Vm)}) {
    const MonitorFigures figures = measure_monitors(kind);
    const std::string key = std::string("bench_plan_") + name;
    out[key + "_monitored_us"] = figures.with_us;
    out[key + "_us"] = figures.without_us;
    out[key + "_monitors_ratio"] = figures.ratio();
    std::printf(
        "bench plan, %s: %.3f us a scan with %zu monitors, %.3f us without (ratio %.2f), over %zu scans; "
        "code entered %.0f and %.0f bytes\n",
        name, figures.with_us, figures.monitors, figures.without_us, figures.ratio(), figures.scans,
        figures.with_bytes, figures.without_bytes);
  }
  std::fflush(stdout);
}

int run(const char* json_file) {
  nlohmann::json out = nlohmann::json::object();
  run_monitors(out);
  for (const Workload& workload : {rungs(1000), loop(), blocks()}) run_workload(workload, out);
  run_growth(1000, 21, out);
  run_growth(10'000, 5, out);
  run_growth(100'000, 1, out);
  if (json_file == nullptr) return 0;
  std::ofstream file(json_file);
  file << out.dump(2) << "\n";
  return file.flush() ? 0 : 1;
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  const bool has_json = argc == 3 && std::strcmp(argv[1], "--json") == 0;
  if (argc != 1 && !has_json) {
    std::fprintf(stderr, "usage: bench_engines [--json FILE]\n");
    return 2;
  }
  try {
    return stepwright::bench::run(has_json ? argv[2] : nullptr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_engines: %s\n", error.what());
    return 1;
  }
}

// The interpreter beside hand-written C++ that does the same, in one process: 1000 rungs with random inputs,
// 10,000 rounds of arithmetic, 300 function block calls, and a whole scan of a small program (60 rungs) with
// its hash and statistics. Prints the ratios. Then what a runtime is measured by in real time: its wake-up
// beside a bare loop.
//
//   bench_scan [--json FILE] [any option of Google Benchmark]

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "runtime/scan/scan_cycle.h"
#include "tests/bench/scan/change.h"
#include "tests/bench/scan/start.h"
#include "tests/bench/scan/wakeup.h"
#include "tests/bench/scan/workloads.h"
#include "tests/support/test_program.h"

namespace stepwright::bench {
namespace {

constexpr std::int64_t kIntervalNs = 10'000'000;
constexpr double kWakeupSeconds = 10.0;

// A new pattern of inputs in every scan, so that no branch predictor learns it.
class RandomInputs {
 public:
  void fill(std::span<std::byte> inputs) {
    for (std::size_t at = 0; at + 4 <= inputs.size(); at += 4) {
      const auto word = static_cast<std::uint32_t>(random_());
      std::memcpy(inputs.data() + at, &word, 4);
    }
  }

 private:
  std::mt19937 random_{1};
};

// A benchmark whose two sides differ measures nothing.
void require(bool equal, const char* workload) {
  if (equal) return;
  std::fprintf(stderr, "bench_scan: the results of %s differ\n", workload);
  std::abort();
}

void check_workloads() {
  const Ladder ladder(1000, 42);
  support::TestProgram program(ladder.bytecode());
  std::vector<std::uint8_t> image(program.image().bytes().size());
  RandomInputs inputs;
  for (int scan = 0; scan < 100; ++scan) {
    inputs.fill(program.image().inputs());
    std::memcpy(image.data(), program.image().inputs().data(), program.image().inputs().size());
    require(!program.run(), "rungs");
    ladder.reference(image.data());
    require(std::memcmp(image.data(), program.image().bytes().data(), image.size()) == 0, "rungs");
  }

  support::TestProgram loop(Arithmetic::bytecode());
  Arithmetic reference;
  require(!loop.run(), "arithmetic");
  reference.reference();
  require(std::memcmp(&reference, loop.image().bytes().data(), 12) == 0, "arithmetic");

  support::TestProgram timers(Timers::bytecode());
  Timers::Image timer_image;
  for (std::int64_t scan = 0; scan < 60; ++scan) {
    timer_image.input = scan > 5 ? 1 : 0;
    timers.write(0, timer_image.input);
    require(!timers.run(scan * kIntervalNs), "timers");
    Timers::reference(timer_image, scan * kIntervalNs);
    require(std::memcmp(&timer_image, timers.image().bytes().data(), sizeof(timer_image)) == 0, "timers");
  }
}

void rungs_vm(benchmark::State& state) {
  support::TestProgram program(Ladder(1000, 42).bytecode());
  RandomInputs inputs;
  for (auto _ : state) {
    inputs.fill(program.image().inputs());
    benchmark::DoNotOptimize(program.run());
  }
}

void rungs_cpp(benchmark::State& state) {
  const Ladder ladder(1000, 42);
  std::vector<std::uint8_t> image(Ladder::kInputs / 8 + 1000);
  RandomInputs inputs;
  for (auto _ : state) {
    inputs.fill(std::as_writable_bytes(std::span(image)).first(Ladder::kInputs / 8));
    ladder.reference(image.data());
    benchmark::ClobberMemory();
  }
}

void arithmetic_vm(benchmark::State& state) {
  support::TestProgram program(Arithmetic::bytecode());
  for (auto _ : state) benchmark::DoNotOptimize(program.run());
}

void arithmetic_cpp(benchmark::State& state) {
  Arithmetic work;
  for (auto _ : state) {
    work.reference();
    benchmark::DoNotOptimize(work);
  }
}

void timers_vm(benchmark::State& state) {
  support::TestProgram program(Timers::bytecode());
  program.write<std::uint8_t>(0, 1);
  std::int64_t now_ns = 0;
  for (auto _ : state) benchmark::DoNotOptimize(program.run(now_ns += kIntervalNs));
}

void timers_cpp(benchmark::State& state) {
  Timers::Image image;
  image.input = 1;
  std::int64_t now_ns = 0;
  for (auto _ : state) {
    Timers::reference(image, now_ns += kIntervalNs);
    benchmark::DoNotOptimize(image);
  }
}

class RandomDriver final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte> inputs) override {
    inputs_.fill(inputs);
    return image::IoStatus::Good;
  }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte>) override {
    return image::IoStatus::Good;
  }

 private:
  RandomInputs inputs_;
};

class SteadyClock final : public scan::Clock {
 public:
  std::int64_t now_ns() override {
    return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
  }
};

// The size of the tank bench's program: 60 rungs, an image just under 2 KB.
void small_scan(benchmark::State& state) {
  writer::ContainerModel model = Ladder(60, 7).bytecode();
  model.sizes.data_bytes = 1900;
  support::TestProgram program(model);
  RandomDriver driver;
  SteadyClock clock;
  std::vector<std::byte> safe_outputs(program.image().outputs().size());
  scan::ScanCycle cycle(program.loaded().program(), program.engine(), program.image(), safe_outputs, driver,
                        clock, {});
  cycle.start({});
  for (auto _ : state) benchmark::DoNotOptimize(cycle.run_scan());
}

// Prints as usual and keeps the times.
class CollectingReporter final : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) times_us[run.benchmark_name()] = run.GetAdjustedRealTime();
    ConsoleReporter::ReportRuns(runs);
  }
  std::map<std::string, double> times_us;
};

// Takes "--json FILE" out of the arguments; the rest is Google Benchmark's.
std::string take_json(int& argc, char** argv) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--json") != 0) continue;
    std::string file = argv[i + 1];
    for (int j = i; j + 2 < argc; ++j) argv[j] = argv[j + 2];
    argc -= 2;
    return file;
  }
  return {};
}

}  // namespace

nlohmann::json summarise(const std::map<std::string, double>& times_us) {
  nlohmann::json out = nlohmann::json::object();
  for (const auto& [name, time] : times_us) out[name + "_us"] = time;
  for (const char* const workload : {"rungs_1000", "arithmetic_10000", "timers_300"}) {
    const auto vm = times_us.find(std::string(workload) + "_vm");
    const auto cpp = times_us.find(std::string(workload) + "_cpp");
    if (vm == times_us.end() || cpp == times_us.end()) continue;
    out[std::string(workload) + "_ratio"] = vm->second / cpp->second;
    std::printf("%-20s interpreter / C++ = %.1f\n", workload, vm->second / cpp->second);
  }
  return out;
}

// The pause is that of the worst change; beside the missed scans those of an equally long run without
// changes.
void add_changes(nlohmann::json& summary) {
  const ChangeFigures figures = measure_changes();
  print(figures);
  summary["online_change_pause_us"] = figures.pause_max_us;
  summary["online_change_pause_p50_us"] = figures.pause_p50_us;
  summary["online_change_pause_p90_us"] = figures.pause_p90_us;
  summary["online_change_over_50_us"] = figures.over_goal;
  summary["bare_work_pause_us"] = figures.bare_max_us;
  summary["bare_work_over_50_us"] = figures.bare_over_goal;
  summary["online_change_prepared_ms"] = figures.prepared_p50_ms;
  summary["missed_scans"] = figures.missed;
  summary["missed_scans_baseline"] = figures.baseline_missed;
}

}  // namespace stepwright::bench

int main(int argc, char** argv) {
  using namespace stepwright::bench;
  const std::string json_file = take_json(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  check_workloads();
  const auto add = [](const char* name, void (*run)(benchmark::State&)) {
    benchmark::RegisterBenchmark(name, run)->Unit(benchmark::kMicrosecond);
  };
  add("rungs_1000_vm", rungs_vm);
  add("rungs_1000_cpp", rungs_cpp);
  add("arithmetic_10000_vm", arithmetic_vm);
  add("arithmetic_10000_cpp", arithmetic_cpp);
  add("timers_300_vm", timers_vm);
  add("timers_300_cpp", timers_cpp);
  add("scan_60_rungs", small_scan);
  CollectingReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  nlohmann::json summary = summarise(reporter.times_us);
  measure_wakeup(kWakeupSeconds, summary);
  add_changes(summary);
  const StartFigures start = measure_start();
  summary["first_scan_ms"] = start.first_scan_ms;
  summary["first_scan_max_ms"] = start.first_scan_max_ms;
  summary["bare_process_ms"] = start.bare_process_ms;
  summary["resident_mb"] = start.resident_mb;
  if (json_file.empty()) return 0;
  std::ofstream file(json_file);
  file << summary.dump(2) << "\n";
  return file.flush() ? 0 : 1;
}

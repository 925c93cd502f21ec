#include "tests/bench/scan/change.h"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "ladder/driver/compile.h"
#include "runtime/host/host_runtime.h"
#include "runtime/host/real_time.h"
#include "runtime/image/no_io.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kVariables = 10'000;
constexpr std::uint32_t kChanges = 100;
constexpr double kGoalUs = 50.0;
constexpr std::uint64_t kProbeRounds = 1'000;
constexpr auto kBetween = std::chrono::milliseconds(25);  // more than the scans on trial

void require(bool good, const std::string& what) {
  if (good) return;
  std::fprintf(stderr, "bench_scan: %s\n", what.c_str());
  std::abort();
}

// Single variables of many types; a tenth of them changes in every scan. Of the other order, no two
// neighbours stay neighbours.
std::vector<std::byte> program(bool other_order) {
  static constexpr const char* kTypes[] = {"DINT", "BOOL", "REAL", "LINT", "INT"};
  std::string declarations = "PROGRAM main\nVAR\n";
  std::string body;
  for (std::uint32_t i = 0; i < kVariables; ++i) {
    // 7919 and the number of variables have no common factor.
    const std::uint32_t k = other_order ? i * 7919u % kVariables : i;
    declarations += "  v" + std::to_string(k) + " : " + kTypes[k % 5] + ";\n";
    if (i % 10 == 0) body += "v" + std::to_string(i) + " := v" + std::to_string(i) + " + 1;\n";
  }
  const std::string text = declarations + "END_VAR\n" + body + "END_PROGRAM\n" +
                           "CONFIGURATION c RESOURCE r ON plc TASK t(INTERVAL := T#1ms, PRIORITY := 0);\n"
                           "PROGRAM main WITH t : main; END_RESOURCE END_CONFIGURATION\n";
  auto output = driver::compile({{{"bench.st", text}}});
  require(output.has_value(), output ? "" : result::to_string(output.error()));
  return std::move(output->container);
}

class Runtime {
 public:
  Runtime() {
    host::HostConfig config;
    config.clock = host::ClockMode::Real;
    auto created = host::HostRuntime::create(config, driver_, nullptr);
    require(created.has_value(), "no runtime");
    runtime_ = std::move(*created);
  }

  host::Completion completion() {
    std::optional<host::Completion> found;
    const auto deadline = Clock::now() + std::chrono::seconds(10);
    while (!(found = runtime_->take_completion()) && Clock::now() < deadline) {
      runtime_->clear();
      pollfd entry{runtime_->descriptor(), POLLIN, 0};
      poll(&entry, 1, 5);
    }
    while (runtime_->take_event()) {
    }
    require(found.has_value(), "no answer");
    return std::move(*found);
  }

  host::HostRuntime& operator*() { return *runtime_; }
  host::HostRuntime* operator->() { return runtime_.get(); }

 private:
  image::NoIo driver_;
  std::unique_ptr<host::HostRuntime> runtime_;
};

double percentile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

std::uint32_t count_over_goal(const std::vector<double>& values_us) {
  return static_cast<std::uint32_t>(
      std::count_if(values_us.begin(), values_us.end(), [](double us) { return us > kGoalUs; }));
}

double since_us(Clock::time_point begin) {
  return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
}

// Work of a given length, as often as there are changes and as far apart, on a thread placed like the scan's:
// how long it really took, each time.
std::vector<double> bare_work_us(double work_us) {
  std::vector<double> took_us;
  std::thread worker([&] {
    host::place_thread({});
    volatile std::uint64_t sink = 0;
    const auto work = [&](std::uint64_t rounds) {
      for (std::uint64_t i = 0; i < rounds; ++i) sink = sink + i;
    };
    // The quickest of many tries says how fast this processor counts.
    double round_us = 1.0;
    for (int i = 0; i < 200; ++i) {
      const auto begin = Clock::now();
      work(kProbeRounds);
      round_us = std::min(round_us, since_us(begin) / kProbeRounds);
    }
    const auto rounds = static_cast<std::uint64_t>(work_us / round_us);
    for (std::uint32_t i = 0; i < kChanges; ++i) {
      std::this_thread::sleep_for(kBetween);
      const auto begin = Clock::now();
      work(rounds);
      took_us.push_back(since_us(begin));
    }
  });
  worker.join();
  return took_us;
}

}  // namespace

ChangeFigures measure_changes() {
  const std::vector<std::byte> programs[] = {program(false), program(true)};
  Runtime runtime;
  require(runtime->load(1, programs[0], "0").has_value(), "the program is refused");
  runtime.completion();
  host::Command start;
  start.kind = host::CommandKind::Start;
  require(runtime->submit(start), "busy");
  runtime.completion();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));

  ChangeFigures figures;
  figures.variables = kVariables;
  figures.changes = kChanges;
  std::vector<double> pauses_us;
  std::vector<double> prepared_ms;
  const host::RuntimeStatus first = runtime->status();
  const auto begin = Clock::now();
  for (std::uint32_t i = 0; i < kChanges; ++i) {
    const auto asked = Clock::now();
    const auto changing =
        runtime->change(i + 2, programs[(i + 1) % 2], std::to_string(i + 1), host::DownloadMode::Change);
    require(changing.has_value(), changing ? "" : result::to_string(changing.error()));
    const host::Completion done = runtime.completion();
    prepared_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - asked).count());
    require(done.outcome == host::Outcome::Done, result::to_string(done.problems));
    require(done.change.carried == kVariables, "variables were not carried");
    pauses_us.push_back(done.change.pause_us);
    std::this_thread::sleep_for(kBetween);
  }
  const auto took = Clock::now() - begin;
  const host::RuntimeStatus second = runtime->status();
  require(second.state == host::RuntimeState::Running, "the program stopped");
  std::this_thread::sleep_for(took);
  const host::RuntimeStatus third = runtime->status();
  figures.pause_p50_us = percentile(pauses_us, 0.5);
  figures.pause_p90_us = percentile(pauses_us, 0.9);
  figures.pause_max_us = *std::max_element(pauses_us.begin(), pauses_us.end());
  figures.over_goal = count_over_goal(pauses_us);
  const std::vector<double> bare_us = bare_work_us(figures.pause_p50_us);
  figures.bare_max_us = *std::max_element(bare_us.begin(), bare_us.end());
  figures.bare_over_goal = count_over_goal(bare_us);
  figures.prepared_p50_ms = percentile(prepared_ms, 0.5);
  figures.scans = second.scan - first.scan;
  figures.missed = second.overruns - first.overruns;
  figures.baseline_scans = third.scan - second.scan;
  figures.baseline_missed = third.overruns - second.overruns;
  return figures;
}

void print(const ChangeFigures& figures) {
  std::printf("online change         %u changes between programs of %u variables, 1 ms in real time\n",
              figures.changes, figures.variables);
  std::printf(
      "  pause               p50 %.1f us, p90 %.1f us, max %.1f us, %u above %.0f us (prepared in %.0f ms)\n",
      figures.pause_p50_us, figures.pause_p90_us, figures.pause_max_us, figures.over_goal, kGoalUs,
      figures.prepared_p50_ms);
  std::printf("  bare work of p50    max %.1f us, %u above %.0f us\n", figures.bare_max_us,
              figures.bare_over_goal, kGoalUs);
  std::printf("  missed scans        %llu of %llu; without changes %llu of %llu\n",
              static_cast<unsigned long long>(figures.missed), static_cast<unsigned long long>(figures.scans),
              static_cast<unsigned long long>(figures.baseline_missed),
              static_cast<unsigned long long>(figures.baseline_scans));
}

}  // namespace stepwright::bench

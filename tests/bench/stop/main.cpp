// How long it takes from a stop, the end of the process, the loss of the supervisor or the begin of a ramp
// until the outputs say so, by the interval of the leading task. Beside it the baseline: a thread that waits
// for nothing but to be woken, rung by another.
//
//   bench_stop [--json FILE] [--rounds N]

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "runtime/host/real_time.h"
#include "runtime/host/wake_signal.h"
#include "tests/bench/stop/plant.h"

namespace stepwright::bench {
namespace {

using host::CommandKind;

constexpr std::array<std::uint32_t, 6> kIntervalsMs = {1, 10, 100, 1'000, 8'000, 60'000};
constexpr std::int64_t kRampMs = 40;
constexpr double kNsPerUs = 1e3;

struct Row {
  std::string name;
  std::vector<double> took_us;

  double percentile(double part) {
    std::sort(took_us.begin(), took_us.end());
    return took_us[static_cast<std::size_t>(part * static_cast<double>(took_us.size() - 1))];
  }
};

// So that the phase of the scan is a random one.
void rest(std::mt19937& random) {
  std::this_thread::sleep_for(std::chrono::microseconds(2'000 + random() % 20'000));
}

Row bare_wake_up(int rounds, std::mt19937& random) {
  Row row{"bare wake-up", {}};
  host::WakeSignal wake;
  std::atomic<std::int64_t> woke_ns{0};
  std::thread sleeper([&] {
    static_cast<void>(host::place_thread({}));
    for (int i = 0; i < rounds; ++i) {
      wake.wait();
      woke_ns.store(now_ns());
    }
  });
  for (int i = 0; i < rounds; ++i) {
    rest(random);
    woke_ns.store(0);
    const std::int64_t asked_ns = now_ns();
    wake.notify();
    while (woke_ns.load() == 0) std::this_thread::sleep_for(std::chrono::microseconds(100));
    row.took_us.push_back(static_cast<double>(woke_ns.load() - asked_ns) / kNsPerUs);
  }
  sleeper.join();
  return row;
}

// `extra_ns`: what the command takes by its nature.
Row measure(const std::string& name, int rounds, std::mt19937& random, Plant& plant,
            const std::function<void(Plant&)>& act, std::int64_t extra_ns = 0) {
  Row row{name, {}};
  for (int i = 0; i < rounds; ++i) {
    plant.start();
    rest(random);
    const std::int64_t asked_ns = now_ns();
    act(plant);
    row.took_us.push_back(static_cast<double>(plant.output_became(0) - asked_ns - extra_ns) / kNsPerUs);
  }
  return row;
}

Row measure_ends(int rounds, std::mt19937& random, std::uint32_t interval_us) {
  Row row{"abort (end of the process)", {}};
  for (int i = 0; i < rounds; ++i) {
    Plant plant(interval_us, 0);
    plant.start();
    rest(random);
    const std::int64_t asked_ns = now_ns();
    plant.end();
    row.took_us.push_back(static_cast<double>(plant.output_became(0) - asked_ns) / kNsPerUs);
  }
  return row;
}

void report(Row row, std::uint32_t interval_ms, nlohmann::json& rows) {
  const double p50 = row.percentile(0.5);
  const double p99 = row.percentile(0.99);
  const double max = row.percentile(1.0);
  std::printf("%8u ms  %-28s p50 %8.1f us  p99 %8.1f us  max %8.1f us\n", interval_ms, row.name.c_str(), p50,
              p99, max);
  std::fflush(stdout);
  rows.push_back({{"interval_ms", interval_ms},
                  {"what", row.name},
                  {"rounds", row.took_us.size()},
                  {"p50_us", p50},
                  {"p99_us", p99},
                  {"max_us", max}});
}

nlohmann::json measure_all(int rounds) {
  std::mt19937 random(1);
  nlohmann::json rows = nlohmann::json::array();
  report(bare_wake_up(rounds, random), 0, rows);
  for (const std::uint32_t interval_ms : kIntervalsMs) {
    const std::uint32_t interval_us = interval_ms * 1'000;
    Plant plant(interval_us, 0);
    report(measure("stop", rounds, random, plant, [](Plant& p) { p.submit(CommandKind::Stop); }), interval_ms,
           rows);
    report(measure("lost supervisor", rounds, random, plant,
                   [](Plant& p) { p.submit(CommandKind::SupervisorLost); }),
           interval_ms, rows);
    report(measure_ends(rounds, random, interval_us), interval_ms, rows);
    Plant ramped(interval_us, kRampMs);
    report(measure(
               "ramp, beyond its 40 ms", rounds, random, ramped,
               [](Plant& p) { p.submit(CommandKind::Stop); }, kRampMs * 1'000'000),
           interval_ms, rows);
  }
  return rows;
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  std::string json_file;
  int rounds = 100;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--json") == 0) json_file = argv[i + 1];
    if (std::strcmp(argv[i], "--rounds") == 0) rounds = std::max(std::atoi(argv[i + 1]), 1);
  }
  const nlohmann::json rows = stepwright::bench::measure_all(rounds);
  if (json_file.empty()) return 0;
  std::ofstream file(json_file);
  file << nlohmann::json{{"rows", rows}}.dump(2) << "\n";
  return file.flush() ? 0 : 1;
}

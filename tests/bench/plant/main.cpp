// Cost of the tank bench in a scan of 10 ms: CVODE through the port driver, the plant alone, and the
// hand-written RK4 of the same equations as baseline; and the same bench as a file of components. All run the
// same job in the same process. Then rows of 10, 100 and 1000 components, and steps of plants in processes of
// their own (tests/bench/shared).
//
//   bench_plant [--json FILE]

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "plant_models/assemblies/tank_bench.h"
#include "plant_models/bridge/plant_driver.h"
#include "runtime/ground/result/exit_code.h"
#include "tests/bench/plant/bench_job.h"
#include "tests/bench/plant/bench_rk4.h"
#include "tests/bench/plant/model_bench.h"
#include "tests/bench/shared/step_rates.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr int kScans = 360'000;  // one simulated hour
constexpr int kRepeats = 5;
constexpr double kSecondsOfProcesses = 2.0;  // each

// The recorded outputs, so that all integrators do the same and pay for no decisions.
std::vector<Outputs> record_job(const assemblies::BenchParameters& parameters) {
  auto plant = assemblies::TankBench::create(parameters).value();
  Job job;
  std::vector<Outputs> outputs;
  outputs.reserve(kScans);
  for (int i = 0; i < kScans; ++i) {
    outputs.push_back(job.next(*plant));
    operate(outputs.back(), *plant);
    plant->advance(10ms);
  }
  return outputs;
}

// The best of several runs, in microseconds per scan: the others were disturbed.
template <typename Run>
double best_us(Run run) {
  double best = 1e300;
  for (int i = 0; i < kRepeats; ++i) {
    const auto start = Clock::now();
    run();
    best = std::min(best, std::chrono::duration<double, std::micro>(Clock::now() - start).count() / kScans);
  }
  return best;
}

double measure_driver(const assemblies::BenchParameters& parameters, const std::vector<Outputs>& job) {
  return best_us([&] {
    auto plant = assemblies::TankBench::create(parameters).value();
    auto driver = bridge::PlantDriver::create(*plant, bridge::default_bench_wires(),
                                              {.input_bytes = 8, .output_bytes = 1})
                      .value();
    std::array<std::byte, 8> inputs{};
    std::array<std::byte, 1> outputs{};
    for (int i = 0; i < kScans; ++i) {
      const std::int64_t now_ns = i * 10'000'000ll;
      driver.read_inputs(now_ns, inputs);
      const Outputs& o = job[static_cast<std::size_t>(i)];
      const unsigned bits = (o[0] ? 1u : 0u) | (o[1] ? 2u : 0u) | (o[4] ? 4u : 0u) | (o[5] ? 8u : 0u) |
                            (o[2] ? 16u : 0u) | (o[3] ? 32u : 0u);
      outputs[0] = static_cast<std::byte>(bits);
      driver.write_outputs(now_ns, outputs);
    }
  });
}

double measure_plant(const assemblies::BenchParameters& parameters, const std::vector<Outputs>& job,
                     ode::CvodeStatistics& statistics) {
  return best_us([&] {
    auto plant = assemblies::TankBench::create(parameters).value();
    for (const Outputs& outputs : job) {
      operate(outputs, *plant);
      plant->advance(10ms);
    }
    statistics = plant->statistics();
  });
}

struct HandResult {
  double us = 0.0;
  double error_percent = 0.0;  // largest level error against CVODE over the first minute
};

HandResult measure_hand(const assemblies::BenchParameters& parameters, const std::vector<Outputs>& job,
                        int steps) {
  const auto scan = [steps](HandBench& hand, const Outputs& o) {
    std::copy_n(o.begin(), 4, hand.inputs.pump.begin());
    hand.inputs.drive = (o[5] ? 1 : 0) - (o[4] ? 1 : 0);
    for (int i = 0; i < steps; ++i) hand.step(0.01 / steps);
  };
  HandResult result;
  result.us = best_us([&] {
    HandBench hand(parameters);
    for (const Outputs& outputs : job) scan(hand, outputs);
  });
  HandBench hand(parameters);
  auto plant = assemblies::TankBench::create(parameters).value();
  for (std::size_t i = 0; i < 6000; ++i) {
    scan(hand, job[i]);
    operate(job[i], *plant);
    plant->advance(10ms);
    for (std::uint32_t tank = 0; tank < 4; ++tank) {
      const double error = std::abs(hand.percent(tank) - plant->truth(core::TruthId(tank)));
      result.error_percent = std::max(result.error_percent, error);
    }
  }
  return result;
}

int run(const char* json_file) {
  const assemblies::BenchParameters parameters;
  const std::vector<Outputs> job = record_job(parameters);
  ode::CvodeStatistics statistics;
  const double driver_us = measure_driver(parameters, job);
  const double plant_us = measure_plant(parameters, job, statistics);
  const HandResult coarse = measure_hand(parameters, job, 1);
  const HandResult fine = measure_hand(parameters, job, 10);
  std::printf("tank bench, %d scans of 10 ms, best of %d runs\n", kScans, kRepeats);
  std::printf("  CVODE with the port driver   %6.3f us per scan  (%.0f times real time)\n", driver_us,
              1e4 / driver_us);
  std::printf("  CVODE, plant alone           %6.3f us per scan  (%lld steps, %lld restarts)\n", plant_us,
              static_cast<long long>(statistics.steps), static_cast<long long>(statistics.restarts));
  std::printf("  hand RK4,  1 step per scan   %6.3f us per scan  ratio %.2f, level error %.3f percent\n",
              coarse.us, plant_us / coarse.us, coarse.error_percent);
  std::printf("  hand RK4, 10 steps per scan  %6.3f us per scan  ratio %.2f, level error %.3f percent\n",
              fine.us, plant_us / fine.us, fine.error_percent);
  const ModelFigures model = measure_model(job, kRepeats);
  std::printf(
      "  components, port driver      %6.3f us per scan  ratio to the built-in one %.2f, level error %.1e "
      "percent\n",
      model.us, model.us / driver_us, model.largest_level_error_percent);
  nlohmann::json growth = nlohmann::json::array();
  for (const std::size_t components : {10u, 100u, 1000u}) {
    const Growth row = measure_row(components);
    std::printf(
        "  a row of %4zu components      %6.2f us per scan  (%.0f times real time; implicit %.2f us), read "
        "in %.1f ms\n",
        row.components, row.scan_us, row.realtime_factor, row.implicit_scan_us, row.load_ms);
    growth.push_back({{"components", row.components},
                      {"states", row.states},
                      {"load_ms", row.load_ms},
                      {"scan_us", row.scan_us},
                      {"realtime_factor", row.realtime_factor},
                      {"implicit_scan_us", row.implicit_scan_us}});
  }
  const bench_shared::StepRates rates = bench_shared::measure_step_rates(kSecondsOfProcesses);
  if (json_file == nullptr) return result::to_int(result::ExitCode::Done);
  const nlohmann::json json = {{"scans", kScans},
                               {"driver_us", driver_us},
                               {"plant_us", plant_us},
                               {"solver_steps", statistics.steps},
                               {"solver_restarts", statistics.restarts},
                               {"model_us", model.us},
                               {"bench_model_ratio", model.us / driver_us},
                               {"realtime_factor_model", model.realtime_factor},
                               {"model_level_error_percent", model.largest_level_error_percent},
                               {"components", library_size()},
                               {"growth", growth},
                               {"fmu_step_us", rates.fmu2_step_us},
                               {"fmu3_step_us", rates.fmu3_step_us},
                               {"shared_steps_per_s_c", rates.c_per_s},
                               {"shared_steps_per_s_python", rates.python_per_s},
                               {"st_steps_per_s", rates.st_per_s},
                               {"baseline_turns_per_s", rates.baseline_turns_per_s},
                               {"rk4_1_us", coarse.us},
                               {"rk4_1_error_percent", coarse.error_percent},
                               {"rk4_10_us", fine.us},
                               {"rk4_10_error_percent", fine.error_percent}};
  std::ofstream file(json_file);
  file << json.dump(2) << "\n";
  return result::to_int(file ? result::ExitCode::Done : result::ExitCode::BadInput);
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  if (argc == 1) return stepwright::bench::run(nullptr);
  if (argc == 3 && std::strcmp(argv[1], "--json") == 0) return stepwright::bench::run(argv[2]);
  std::fprintf(stderr, "usage: bench_plant [--json FILE]\n");
  return stepwright::result::to_int(stepwright::result::ExitCode::Usage);
}

#include "tests/unit/plant_models/assemblies/bench_rig.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stepwright::assemblies {

using namespace std::chrono_literals;

BenchParameters BenchRig::exact() {
  BenchParameters parameters;
  parameters.uncertainty = SensorUncertainty::none();
  return parameters;
}

BenchRig::BenchRig(const BenchParameters& parameters) {
  auto plant = TankBench::create(parameters);
  if (!plant) throw std::runtime_error(result::to_string(plant.error()));
  plant_ = std::move(*plant);
}

void BenchRig::set(std::string_view actuator, bool on) {
  plant_->set_actuator(core::find_actuator(*plant_, actuator).value(), on);
}

int BenchRig::sensor(std::string_view name) const {
  return plant_->sensor(core::find_sensor(*plant_, name).value());
}

double BenchRig::truth(std::string_view name) const {
  return plant_->truth(core::find_truth(*plant_, name).value());
}

void BenchRig::run(double seconds) {
  for (long scans = std::lround(seconds * 100.0); scans > 0; --scans) {
    ASSERT_EQ(plant_->advance(10ms), core::PlantStatus::Good);
  }
}

double BenchRig::run_until(const std::function<bool()>& condition, double limit_s) {
  double seconds = 0.0;
  while (!condition() && seconds < limit_s) {
    run(0.01);
    seconds += 0.01;
  }
  EXPECT_LT(seconds, limit_s) << "the condition never held";
  return seconds;
}

double BenchRig::drive(std::string_view output, std::string_view until_switch) {
  set(output, true);
  double seconds = run_until([&] { return sensor(until_switch) != 0; });
  set(output, false);
  seconds += run_until([&] { return truth("speed") == 0.0; });
  return seconds;
}

void BenchRig::pump(std::string_view output, double seconds) {
  set(output, true);
  run(seconds);
  set(output, false);
  run(2.0);
}

}  // namespace stepwright::assemblies

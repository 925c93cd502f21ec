#pragma once

// A tank bench with its terminals by name, for tests that operate it by hand.

#include <chrono>
#include <functional>
#include <memory>
#include <string_view>

#include "plant_models/assemblies/tank_bench.h"

namespace stepwright::assemblies {

class BenchRig {
 public:
  explicit BenchRig(const BenchParameters& parameters = exact());

  // The default bench with exact sensors.
  static BenchParameters exact();

  TankBench& plant() { return *plant_; }
  void set(std::string_view actuator, bool on);
  int sensor(std::string_view name) const;
  double truth(std::string_view name) const;

  // Runs in scans of 10 ms and expects the plant to stay good.
  void run(double seconds);

  // Runs until the condition holds; gives the seconds that took, and fails the test after `limit_s`.
  double run_until(const std::function<bool()>& condition, double limit_s = 60.0);

  // Drives to the place of a switch and brakes there; gives the seconds until standstill.
  double drive(std::string_view output, std::string_view until_switch);

  // Runs a pump for a time and lets it run down.
  void pump(std::string_view output, double seconds);

 private:
  std::unique_ptr<TankBench> plant_;
};

}  // namespace stepwright::assemblies

#pragma once

// The tank bench once more, written by hand as one piecewise function and integrated with fixed-step RK4:
// the baseline of the benchmark and, with small steps, the accuracy oracle of the tests. It shares the
// parameters with the plant and nothing else: no modes, no root-finding; every step looks anew.

#include <array>
#include <cstddef>

#include "plant_models/assemblies/bench_parameters.h"

namespace stepwright::bench {

struct HandState {
  double x = 0.0, v = 0.0;
  std::array<double, 4> volume{};  // m3: f1, v1, a1, a2
  double sump = 0.0;
  std::array<double, 4> w{};
};

struct HandInputs {
  std::array<bool, 4> pump{};
  int drive = 0;
};

class HandBench {
 public:
  explicit HandBench(const assemblies::BenchParameters& parameters);

  HandInputs inputs;
  std::array<double, 4> leak_m3_s{};
  const HandState& state() const { return state_; }
  double percent(std::size_t tank) const;

  // One classical Runge-Kutta step, then the switch, the end stops and the dry friction.
  void step(double h_s);

 private:
  HandState slope(const HandState& s) const;
  void settle(double speed_before);

  assemblies::BenchParameters p_;
  HandState state_;
  int place_ = 3;
  int direction_ = 0;
};

}  // namespace stepwright::bench

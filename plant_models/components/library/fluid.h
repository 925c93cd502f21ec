#pragma once

// Common laws of the components that liquid flows through. Pure.

#include <cmath>

#include "plant_models/components/component.h"

namespace stepwright::components::library {

// m3/s of the flow with nominal values, in both directions, without an infinite slope at zero:
// q = q_n x / (x^2 + d^2)^(1/4) with x = dp / dp_n (Modelica.Fluid.Utilities.regRoot).
inline double turbulent(double nominal_flow, double relative_drop) {
  constexpr double kSmooth = 1e-3;
  return nominal_flow * relative_drop /
         std::sqrt(std::sqrt(relative_drop * relative_drop + kSmooth * kSmooth));
}

// A component with two ends that liquid flows through.
class Through : public Component {
 protected:
  Through(std::size_t in, std::size_t out) : in_(in), out_(out) {}

  double pressure_drop(const Frame& f) const {
    return across(f, in_, kPressure) - across(f, out_, kPressure);
  }

  // Lets `wanted` flow, or as much of it as there is at the end where it comes from; gives what flows.
  double set_flow(const Frame& f, double wanted) const {
    const std::size_t from = wanted >= 0.0 ? in_ : out_;
    const double flow = wanted * across(f, from, kAvailable);
    const double heat = flow * across(f, from, kTemperature);
    through(f, in_, kFlow) = -flow;
    through(f, in_, kHeatFlow) = -heat;
    through(f, out_, kFlow) = flow;
    through(f, out_, kHeatFlow) = heat;
    return flow;
  }

 private:
  std::size_t in_;
  std::size_t out_;
};

}  // namespace stepwright::components::library

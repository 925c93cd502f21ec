#include <algorithm>

#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kLiquid, kLeak, kLevel, kGauge };
enum Fault : std::size_t { kLeaks };
constexpr double kAtmosphere = 101325.0;  // Pa

// A vessel with gas above the liquid, which is compressed without becoming warmer: p V = constant (Boyle).
class ClosedTank final : public Component {
 public:
  explicit ClosedTank(const Parameters& p)
      : capacity_(p["volume"]), height_(p["height"]), weight_(p.weight()), temperature_(p["temperature"]) {
    const double content = p["start"] * capacity_;
    add_state({.start = content, .tolerance = 1e-9, .liquid = 1.0});
    gas_ = (p["gas_pressure"] + kAtmosphere) * (capacity_ - content);
  }
  void evaluate(std::uint32_t, const Frame& f) const override {
    const double content = y(f, 0);
    const double gas = std::max(capacity_ - content, 1e-4 * capacity_);
    const double gauge = gas_ / gas - kAtmosphere;
    const double available = std::clamp(content / (5e-3 * capacity_), 0.0, 1.0);
    across(f, kLiquid, kPressure) = gauge + weight_ * height_ * content / capacity_;
    across(f, kLiquid, kAvailable) = available;
    across(f, kLiquid, kTemperature) = temperature_;
    across(f, kLevel) = content / capacity_;
    across(f, kGauge) = gauge;
    const double leak = fault(kLeaks) * capacity_ * available;
    through(f, kLeak, kFlow) = leak;
    through(f, kLeak, kHeatFlow) = leak * temperature_;
  }
  void derivative(const Frame& f) const override {
    dydt(f, 0) = through(f, kLiquid, kFlow) - through(f, kLeak, kFlow);
  }

 private:
  double capacity_, height_, weight_, temperature_;
  double gas_ = 0.0;  // pressure times volume, N m
};

}  // namespace

ComponentType closed_tank_type() {
  return {.name = "closed_tank",
          .meaning = "a pressure vessel: gas above the liquid is compressed as it fills",
          .parameters = {{.name = "volume",
                          .unit = "m3",
                          .fallback = "",
                          .low = 1e-9,
                          .high = 1e6,
                          .meaning = "of the whole vessel"},
                         {.name = "height",
                          .unit = "m",
                          .fallback = "1 m",
                          .low = 1e-4,
                          .high = 1e3,
                          .meaning = "of the vessel"},
                         {.name = "start",
                          .unit = "percent",
                          .fallback = "0 percent",
                          .low = 0.0,
                          .high = 0.999,
                          .meaning = "level at the start"},
                         {.name = "gas_pressure",
                          .unit = "Pa",
                          .fallback = "0 bar",
                          .low = -1e5,
                          .high = 1e9,
                          .meaning = "at the start, above that of the room"},
                         {.name = "temperature",
                          .unit = "K",
                          .fallback = "20 degC",
                          .low = 1.0,
                          .high = 5e3,
                          .meaning = "of the liquid"}},
          .ports = {{.name = "liquid",
                     .kind = PortKind::Fluid,
                     .role = Role::Node,
                     .open = Open::Fine,
                     .meaning = "at its bottom"},
                    {.name = "leak",
                     .kind = PortKind::Fluid,
                     .open = Open::Floor,
                     .meaning = "where a leak runs to"},
                    {.name = "level",
                     .role = Role::Node,
                     .unit = "percent",
                     .open = Open::Fine,
                     .meaning = "volume as a share of the vessel"},
                    {.name = "pressure",
                     .role = Role::Node,
                     .unit = "bar",
                     .open = Open::Fine,
                     .meaning = "of the gas, above that of the room"}},
          .faults = {{.name = "leak",
                      .unit = "percent/s",
                      .low = 0.0,
                      .high = 100.0,
                      .rest = 0.0,
                      .meaning = "it leaks at this rate while it holds liquid",
                      .usual = 5.0}},
          .make = [](const Parameters& p) { return std::make_unique<ClosedTank>(p); }};
}

}  // namespace stepwright::components::library

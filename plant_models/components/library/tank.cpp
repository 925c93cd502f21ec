#include <algorithm>
#include <cmath>

#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kLiquid, kHeat, kOverflow, kLeak, kLevel, kVolume, kTemperatureOut, kHeight };
enum Fault : std::size_t { kLeaks };
enum State : std::size_t { kContent, kContentHeat };

class Tank final : public Component {
 public:
  explicit Tank(const Parameters& p)
      : capacity_(p["volume"]),
        height_(p["height"]),
        suction_(p["suction"] * capacity_),
        overflow_rate_(p["overflow_rate"]),
        weight_(p.weight()),
        start_k_(p["temperature"]),
        room_k_(p.room_k),
        loss_(p["heat_loss"] / (p.density_kg_m3 * p.heat_capacity_j_kg_k)),
        per_joule_(1.0 / (p.density_kg_m3 * p.heat_capacity_j_kg_k)),
        conical_(p.is("shape", "cone")),
        thermal_(p.is("thermal", "yes")) {
    const double content = p["start"] * capacity_;
    // Of a thermal tank both are exact to a hundredth of the trace, so that an empty one has a temperature.
    add_state(
        {.start = content, .tolerance = thermal_ ? std::min(1e-9, 0.01 * trace()) : 1e-9, .liquid = 1.0});
    if (thermal_)
      add_state({.start = (content + trace()) * start_k_, .tolerance = 0.01 * trace(), .heat = 1.0});
    set_roots(2);
  }

  void evaluate(std::uint32_t, const Frame& f) const override {
    const double content = y(f, kContent);
    const double share = content / capacity_;
    const double height = height_ * (conical_ ? std::cbrt(std::max(0.0, share)) : share);
    const double available = std::clamp(content / suction_, 0.0, 1.0);
    const double warm = temperature(f);
    across(f, kLiquid, kPressure) = weight_ * height;
    across(f, kLiquid, kAvailable) = available;
    across(f, kLiquid, kTemperature) = warm;
    across(f, kHeat) = warm;
    across(f, kHeat, kContact) = available;
    across(f, kLevel) = share;
    across(f, kVolume) = content;
    across(f, kTemperatureOut) = warm;
    across(f, kHeight) = height;
    const double over = overflow_rate_ * std::max(0.0, content - capacity_);
    const double leak = fault(kLeaks) * capacity_ * available;
    through(f, kOverflow, kFlow) = over;
    through(f, kOverflow, components::kHeatFlow) = over * warm;
    through(f, kLeak, kFlow) = leak;
    through(f, kLeak, components::kHeatFlow) = leak * warm;
  }

  void derivative(const Frame& f) const override {
    dydt(f, kContent) = through(f, kLiquid, kFlow) - through(f, kOverflow, kFlow) - through(f, kLeak, kFlow);
    if (!thermal_) return;
    dydt(f, kContentHeat) = through(f, kLiquid, components::kHeatFlow) -
                            through(f, kOverflow, components::kHeatFlow) -
                            through(f, kLeak, components::kHeatFlow) + per_joule_ * through(f, kHeat) -
                            loss_ * across(f, kHeat, kContact) * (across(f, kHeat) - room_k_);
  }

  void roots(const Frame& f, double* g) const override {
    g[0] = (y(f, kContent) - suction_) / capacity_;
    g[1] = (y(f, kContent) - capacity_) / capacity_;
  }
  Event handle(const Frame&, const int*, double*) override { return Event::Restart; }

 private:
  // So little that it shows nowhere, and more than a solver may be below nothing: an empty tank has a
  // temperature as well.
  double trace() const { return 1e-6 * capacity_; }
  double temperature(const Frame& f) const {
    if (!thermal_) return start_k_;
    return y(f, kContentHeat) / std::max(y(f, kContent) + trace(), 0.5 * trace());
  }

  double capacity_, height_, suction_, overflow_rate_, weight_, start_k_, room_k_, loss_, per_joule_;
  bool conical_, thermal_;
};

}  // namespace

ComponentType tank_type() {
  return {
      .name = "tank",
      .meaning = "an open tank: what flows in and out changes its level; what is above 100 percent overflows",
      .parameters = {{.name = "volume",
                      .unit = "m3",
                      .fallback = "",
                      .low = 1e-9,
                      .high = 1e6,
                      .meaning = "at 100 percent"},
                     {.name = "height",
                      .unit = "m",
                      .fallback = "1 m",
                      .low = 1e-4,
                      .high = 1e3,
                      .meaning = "of the liquid at 100 percent, above its outlet"},
                     {.name = "start",
                      .unit = "percent",
                      .fallback = "0 percent",
                      .low = 0.0,
                      .high = 1.0,
                      .meaning = "level at the start"},
                     {.name = "shape",
                      .unit = "",
                      .fallback = "upright",
                      .meaning = "upright: the same section everywhere; cone: its tip is below",
                      .choices = {"upright", "cone"}},
                     {.name = "suction",
                      .unit = "percent",
                      .fallback = "0.5 percent",
                      .low = 1e-6,
                      .high = 1.0,
                      .meaning = "below this level outlets suck air, and what flows out fades to nothing"},
                     {.name = "overflow_rate",
                      .unit = "1/s",
                      .fallback = "20 1/s",
                      .low = 1e-3,
                      .high = 1e4,
                      .meaning = "of what is above 100 percent"},
                     {.name = "thermal",
                      .unit = "",
                      .fallback = "no",
                      .meaning = "whether its temperature changes",
                      .choices = {"no", "yes"}},
                     {.name = "temperature",
                      .unit = "K",
                      .fallback = "20 degC",
                      .low = 1.0,
                      .high = 5e3,
                      .meaning = "at the start"},
                     {.name = "heat_loss",
                      .unit = "W/K",
                      .fallback = "0 W/K",
                      .low = 0.0,
                      .high = 1e9,
                      .meaning = "to the room"}},
      .ports = {{.name = "liquid",
                 .kind = PortKind::Fluid,
                 .role = Role::Node,
                 .open = Open::Fine,
                 .meaning = "what pipes, pumps and valves are joined to"},
                {.name = "heat",
                 .kind = PortKind::Heat,
                 .role = Role::Node,
                 .open = Open::Fine,
                 .meaning = "a heater, a cooler"},
                {.name = "overflow",
                 .kind = PortKind::Fluid,
                 .role = Role::Branch,
                 .open = Open::Floor,
                 .meaning = "where it overflows to"},
                {.name = "leak",
                 .kind = PortKind::Fluid,
                 .role = Role::Branch,
                 .open = Open::Floor,
                 .meaning = "where a leak runs to"},
                {.name = "level",
                 .role = Role::Node,
                 .unit = "percent",
                 .open = Open::Fine,
                 .meaning = "volume as a share of that at 100 percent"},
                {.name = "volume_out",
                 .role = Role::Node,
                 .unit = "l",
                 .open = Open::Fine,
                 .meaning = "of the liquid in it"},
                {.name = "temperature_out",
                 .role = Role::Node,
                 .unit = "degC",
                 .open = Open::Fine,
                 .meaning = "of the liquid in it, well stirred"},
                {.name = "liquid_height",
                 .role = Role::Node,
                 .unit = "m",
                 .open = Open::Fine,
                 .meaning = "above the outlet"}},
      .faults = {{.name = "leak",
                  .unit = "percent/s",
                  .low = 0.0,
                  .high = 100.0,
                  .rest = 0.0,
                  .meaning = "it leaks at this rate while it holds liquid",
                  .usual = 5.0}},
      .make = [](const Parameters& p) { return std::make_unique<Tank>(p); }};
}

}  // namespace stepwright::components::library

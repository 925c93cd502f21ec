#include <algorithm>
#include <cmath>

#include "plant_models/components/library/fault_specs.h"
#include "plant_models/components/library/fluid.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kIn, kOut, kCommand, kPosition, kFlowOut };
enum Fault : std::size_t { kStuck, kBlocked, kLeaks, kSlow };
constexpr double kBar = 1e5;     // of which a flow coefficient Kv speaks (IEC 60534-1)
constexpr double kSharp = 20.0;  // the positioner brakes in the last twentieth of its travel

class ControlValve final : public Through {
 public:
  explicit ControlValve(const Parameters& p)
      : Through(kIn, kOut),
        full_(p["kv"]),
        travel_(p["travel"]),
        ratio_(p["rangeability"]),
        percentage_(p.is("characteristic", "equal_percentage")) {
    add_state({.start = p["start"], .tolerance = 1e-6});
  }

  void evaluate(std::uint32_t stage, const Frame& f) const override {
    const double position = std::clamp(y(f, 0), 0.0, 1.0);
    if (stage == 0) {
      across(f, kPosition) = y(f, 0);
      return;
    }
    const double opening = std::max(opening_at(position), fault(kLeaks)) * (1.0 - fault(kBlocked));
    across(f, kFlowOut) = set_flow(f, turbulent(full_ * opening, pressure_drop(f) / kBar));
  }

  void derivative(const Frame& f) const override {
    if (fault(kStuck) >= 0.5) {
      dydt(f, 0) = 0.0;
      return;
    }
    const double wanted = std::clamp(across(f, kCommand), 0.0, 1.0);
    dydt(f, 0) = std::clamp(kSharp * (wanted - y(f, 0)), -1.0, 1.0) / (travel_ * fault(kSlow));
  }

 private:
  // Linear, or equal percentage: R^(x - 1) above the smallest opening that can be controlled, closed at 0.
  double opening_at(double position) const {
    if (!percentage_) return position;
    const double lowest = 1.0 / ratio_;
    return std::min(position * ratio_ * lowest * 10.0, 1.0) * std::pow(ratio_, position - 1.0);
  }

  double full_, travel_, ratio_;
  bool percentage_;
};

}  // namespace

ComponentType control_valve_type() {
  return {
      .name = "control_valve",
      .meaning = "a valve that opens as far as it is told, in its time",
      .parameters = {{.name = "kv",
                      .unit = "m3/s",
                      .fallback = "",
                      .low = 1e-12,
                      .high = 1e3,
                      .meaning = "flow of water at 1 bar, fully open"},
                     {.name = "travel",
                      .unit = "s",
                      .fallback = "5 s",
                      .low = 1e-2,
                      .high = 1e4,
                      .meaning = "from closed to open"},
                     {.name = "start",
                      .unit = "percent",
                      .fallback = "0 percent",
                      .low = 0.0,
                      .high = 1.0,
                      .meaning = "position at the start"},
                     {.name = "characteristic",
                      .unit = "",
                      .fallback = "linear",
                      .meaning = "how flow follows position",
                      .choices = {"linear", "equal_percentage"}},
                     {.name = "rangeability",
                      .unit = "",
                      .fallback = "50",
                      .low = 2.0,
                      .high = 500.0,
                      .meaning = "of an equal percentage"}},
      .ports = {{.name = "in", .kind = PortKind::Fluid, .stage = 1, .reads = 1, .meaning = "one end"},
                {.name = "out", .kind = PortKind::Fluid, .stage = 1, .reads = 1, .meaning = "the other end"},
                {.name = "command", .unit = "percent", .meaning = "wanted position"},
                {.name = "position",
                 .role = Role::Node,
                 .unit = "percent",
                 .open = Open::Fine,
                 .meaning = "of its stem"},
                {.name = "flow",
                 .role = Role::Node,
                 .unit = "l/s",
                 .stage = 1,
                 .open = Open::Fine,
                 .meaning = "from in to out"}},
      .faults = {flag_fault("stuck", "1: it stays where it is"),
                 {.name = "blocked",
                  .unit = "percent",
                  .low = 0.0,
                  .high = 100.0,
                  .rest = 0.0,
                  .meaning = "by this much less flows"},
                 {.name = "leak",
                  .unit = "percent",
                  .low = 0.0,
                  .high = 100.0,
                  .rest = 0.0,
                  .meaning = "it never closes further than this"},
                 {.name = "slow",
                  .unit = "",
                  .low = 1.0,
                  .high = 1000.0,
                  .rest = 1.0,
                  .meaning = "it takes so many times its travel time",
                  .usual = 10.0}},
      .stages = 2,
      .make = [](const Parameters& p) { return std::make_unique<ControlValve>(p); }};
}

}  // namespace stepwright::components::library

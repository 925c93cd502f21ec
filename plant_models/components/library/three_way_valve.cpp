#include <algorithm>

#include "plant_models/components/library/fault_specs.h"
#include "plant_models/components/library/fluid.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kCommon, kA, kB, kCommand, kPosition };
enum Fault : std::size_t { kStuck, kSlow };
constexpr double kBar = 1e5;

// Two valves on one stem: what closes one way opens the other. It mixes or divides, as the pressures are.
class ThreeWayValve final : public Component {
 public:
  explicit ThreeWayValve(const Parameters& p) : full_(p["kv"]), travel_(p["travel"]) {
    add_state({.start = p["start"], .tolerance = 1e-6});
  }
  void evaluate(std::uint32_t stage, const Frame& f) const override {
    if (stage == 0) {
      across(f, kPosition) = y(f, 0);
      return;
    }
    const double open = std::clamp(y(f, 0), 0.0, 1.0);
    double flow = 0.0;
    double heat = 0.0;
    way(f, kA, open, flow, heat);
    way(f, kB, 1.0 - open, flow, heat);
    through(f, kCommon, kFlow) = -flow;
    through(f, kCommon, kHeatFlow) = -heat;
  }
  void derivative(const Frame& f) const override {
    const double wanted = std::clamp(across(f, kCommand), 0.0, 1.0);
    const double speed = std::clamp(20.0 * (wanted - y(f, 0)), -1.0, 1.0);
    dydt(f, 0) = fault(kStuck) >= 0.5 ? 0.0 : speed / (travel_ * fault(kSlow));
  }

 private:
  void way(const Frame& f, std::size_t port, double open, double& flow, double& heat) const {
    const double drop = across(f, kCommon, kPressure) - across(f, port, kPressure);
    const std::size_t from = drop >= 0.0 ? static_cast<std::size_t>(kCommon) : port;
    const double q = turbulent(full_ * open, drop / kBar) * across(f, from, kAvailable);
    through(f, port, kFlow) = q;
    through(f, port, kHeatFlow) = q * across(f, from, kTemperature);
    flow += q;
    heat += through(f, port, kHeatFlow);
  }
  double full_, travel_;
};

}  // namespace

ComponentType three_way_valve_type() {
  return {
      .name = "three_way_valve",
      .meaning = "joins its common end to a and b: to a as far as it is open, to b as far as it is not",
      .parameters = {{.name = "kv",
                      .unit = "m3/s",
                      .fallback = "",
                      .low = 1e-12,
                      .high = 1e3,
                      .meaning = "flow of water at 1 bar, one way fully open"},
                     {.name = "travel",
                      .unit = "s",
                      .fallback = "5 s",
                      .low = 1e-2,
                      .high = 1e4,
                      .meaning = "from one end to the other"},
                     {.name = "start",
                      .unit = "percent",
                      .fallback = "0 percent",
                      .low = 0.0,
                      .high = 1.0,
                      .meaning = "position at the start"}},
      .ports =
          {{.name = "common",
            .kind = PortKind::Fluid,
            .stage = 1,
            .reads = 1,
            .meaning = "the end that both ways have"},
           {.name = "a", .kind = PortKind::Fluid, .stage = 1, .reads = 1, .meaning = "open at 100 percent"},
           {.name = "b", .kind = PortKind::Fluid, .stage = 1, .reads = 1, .meaning = "open at 0 percent"},
           {.name = "command", .unit = "percent", .meaning = "wanted position"},
           {.name = "position",
            .role = Role::Node,
            .unit = "percent",
            .open = Open::Fine,
            .meaning = "of its stem"}},
      .faults = {flag_fault("stuck", "1: it stays where it is"),
                 {.name = "slow",
                  .low = 1.0,
                  .high = 1000.0,
                  .rest = 1.0,
                  .meaning = "it takes so many times its travel time",
                  .usual = 10.0}},
      .stages = 2,
      .make = [](const Parameters& p) { return std::make_unique<ThreeWayValve>(p); }};
}

}  // namespace stepwright::components::library

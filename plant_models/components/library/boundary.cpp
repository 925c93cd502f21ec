// Where liquid comes from and where it goes to: both count it, so that nothing is lost.

#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kLiquid, kVolume, kFlowOut };

// A large vessel or a main: its pressure does not change, whatever flows.
class Boundary final : public Component {
 public:
  Boundary(const Parameters& p, bool gives)
      : pressure_(p["pressure"]), temperature_(p["temperature"]), sign_(gives ? -1.0 : 1.0), gives_(gives) {
    add_state({.tolerance = 1e-9, .liquid = 1.0});
  }
  void evaluate(std::uint32_t stage, const Frame& f) const override {
    if (stage == 1) {
      across(f, kFlowOut) = sign_ * through(f, kLiquid, kFlow);
      return;
    }
    across(f, kLiquid, kPressure) = pressure_;
    across(f, kLiquid, kAvailable) = gives_ ? 1.0 : 0.0;
    across(f, kLiquid, kTemperature) = temperature_;
    across(f, kVolume) = sign_ * y(f, 0);
  }
  void derivative(const Frame& f) const override { dydt(f, 0) = through(f, kLiquid, kFlow); }

 private:
  double pressure_, temperature_, sign_;
  bool gives_;
};

ComponentType boundary(const char* name, const char* meaning, const char* volume, const char* flow,
                       bool gives) {
  return {
      .name = name,
      .meaning = meaning,
      .parameters = {{.name = "pressure",
                      .unit = "Pa",
                      .fallback = "0 bar",
                      .low = -1e5,
                      .high = 1e9,
                      .meaning = "above that of the room"},
                     {.name = "temperature",
                      .unit = "K",
                      .fallback = "20 degC",
                      .low = 1.0,
                      .high = 5e3,
                      .meaning = "of what comes from it"}},
      .ports = {{.name = "liquid",
                 .kind = PortKind::Fluid,
                 .role = Role::Node,
                 .reads = 1,
                 .open = Open::Fine,
                 .meaning = "what it is joined to"},
                {.name = volume, .role = Role::Node, .unit = "l", .open = Open::Fine, .meaning = "so far"},
                {.name = flow,
                 .role = Role::Node,
                 .unit = "l/s",
                 .stage = 1,
                 .open = Open::Fine,
                 .meaning = "at present"}},
      .faults = {},
      .stages = 2,
      .make = [gives](const Parameters& p) { return std::make_unique<Boundary>(p, gives); }};
}

}  // namespace

ComponentType source_type() {
  return boundary("source", "a main: as much liquid as is wanted, at a constant pressure", "delivered",
                  "flow", true);
}
ComponentType sink_type() {
  return boundary("sink", "a drain: takes what flows into it and gives nothing back", "received", "flow",
                  false);
}

}  // namespace stepwright::components::library

#include "plant_models/components/floor.h"

namespace stepwright::components {
namespace {

enum Port : std::size_t { kLiquid, kVolume };

class Floor final : public Component {
 public:
  explicit Floor(double room_k) : room_k_(room_k) { add_state({.tolerance = 1e-9, .liquid = 1.0}); }

  void evaluate(std::uint32_t, const Frame& f) const override {
    across(f, kLiquid, kPressure) = 0.0;
    across(f, kLiquid, kAvailable) = 0.0;
    across(f, kLiquid, kTemperature) = room_k_;
    across(f, kVolume) = y(f, 0);
  }
  void derivative(const Frame& f) const override { dydt(f, 0) = through(f, kLiquid, kFlow); }

 private:
  double room_k_;
};

}  // namespace

const ComponentType& floor_type() {
  static const ComponentType kType = {
      .name = "floor",
      .meaning = "takes what overflows or leaks, for good; every plant with liquid has one",
      .parameters = {},
      .ports = {{.name = "liquid",
                 .kind = PortKind::Fluid,
                 .role = Role::Node,
                 .open = Open::Fine,
                 .meaning = "what is spilt"},
                {.name = "volume",
                 .kind = PortKind::Signal,
                 .role = Role::Node,
                 .unit = "l",
                 .open = Open::Fine,
                 .meaning = "liquid spilt or leaked so far"}},
      .faults = {},
      .make = [](const Parameters& p) { return std::make_unique<Floor>(p.room_k); }};
  return kType;
}

}  // namespace stepwright::components

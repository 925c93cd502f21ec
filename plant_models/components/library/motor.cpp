#include <algorithm>

#include "plant_models/components/library/fault_specs.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kShaft, kEnable, kReference, kSpeed, kTorque, kCurrent };
enum Fault : std::size_t { kWeak, kBlocked };

// A motor on a drive whose current loop is fast beside everything else: the speed controller sets the
// current, i = clamp(K (w_ref - w), +-i_max), and J dw/dt = k_t i - b w + load.
class Motor final : public Component {
 public:
  explicit Motor(const Parameters& p)
      : nominal_(p["nominal_speed"]),
        inertia_(p["inertia"]),
        friction_(p["friction"]),
        torque_(p["torque_constant"]),
        limit_(p["current_limit"]),
        gain_(p["gain"]) {
    add_state({.tolerance = 1e-5});
  }
  void evaluate(std::uint32_t, const Frame& f) const override {
    across(f, kShaft) = y(f, 0);
    across(f, kSpeed) = y(f, 0);
    const bool on = across(f, kEnable) >= 0.5;
    const double current =
        on ? std::clamp(gain_ * (across(f, kReference) * nominal_ - y(f, 0)), -limit_, limit_) : 0.0;
    across(f, kCurrent) = current;
    across(f, kTorque) = torque_ * current * fault(kWeak);
  }
  void derivative(const Frame& f) const override {
    const double torque = across(f, kTorque) - friction_ * y(f, 0) + through(f, kShaft);
    // A rotor that is jammed stands still at once.
    dydt(f, 0) = fault(kBlocked) >= 0.5 ? -100.0 * y(f, 0) : torque / inertia_;
  }

 private:
  double nominal_, inertia_, friction_, torque_, limit_, gain_;
};

}  // namespace

ComponentType motor_type() {
  return {.name = "motor",
          .meaning = "a motor with its drive: follows a speed as far as its current lets it",
          .parameters = {{.name = "nominal_speed",
                          .unit = "rad/s",
                          .fallback = "1500 rpm",
                          .low = 1e-3,
                          .high = 1e5,
                          .meaning = "at a reference of 100 percent"},
                         {.name = "inertia",
                          .unit = "kg m2",
                          .fallback = "0.01 kg m2",
                          .low = 1e-9,
                          .high = 1e6,
                          .meaning = "with what it turns"},
                         {.name = "friction",
                          .unit = "N m s",
                          .fallback = "0.001 N m s",
                          .low = 0.0,
                          .high = 1e6,
                          .meaning = "per speed"},
                         {.name = "torque_constant",
                          .unit = "N m/A",
                          .fallback = "1 N m/A",
                          .low = 1e-6,
                          .high = 1e4,
                          .meaning = "torque per current"},
                         {.name = "current_limit",
                          .unit = "A",
                          .fallback = "10 A",
                          .low = 1e-6,
                          .high = 1e5,
                          .meaning = "of the drive"},
                         {.name = "gain",
                          .unit = "A s",
                          .fallback = "1 A s",
                          .low = 1e-6,
                          .high = 1e6,
                          .meaning = "current per error of speed"}},
          .ports = {{.name = "shaft",
                     .kind = PortKind::Rotation,
                     .role = Role::Node,
                     .open = Open::Fine,
                     .meaning = "what it turns"},
                    {.name = "enable", .kind = PortKind::Logic, .reads = 0, .meaning = "the drive is on"},
                    {.name = "reference",
                     .unit = "percent",
                     .reads = 0,
                     .open = Open::Constant,
                     .constant = 1.0,
                     .meaning = "wanted speed"},
                    {.name = "speed",
                     .role = Role::Node,
                     .unit = "rpm",
                     .open = Open::Fine,
                     .meaning = "of the shaft"},
                    {.name = "torque",
                     .role = Role::Node,
                     .unit = "N m",
                     .open = Open::Fine,
                     .meaning = "of the motor"},
                    {.name = "current",
                     .role = Role::Node,
                     .unit = "A",
                     .open = Open::Fine,
                     .meaning = "of the drive"}},
          .faults = {{.name = "weak",
                      .low = 0.0,
                      .high = 1.0,
                      .rest = 1.0,
                      .meaning = "it has this share of its torque"},
                     flag_fault("blocked", "1: its rotor is jammed")},
          .make = [](const Parameters& p) { return std::make_unique<Motor>(p); }};
}

}  // namespace stepwright::components::library

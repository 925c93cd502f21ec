#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kHeat, kCommand, kShare, kPower };
enum Fault : std::size_t { kWeak, kStuck };

class Heater final : public Component {
 public:
  explicit Heater(const Parameters& p) : power_(p["power"]), time_constant_(p["time_constant"]) {
    add_state({.tolerance = 1e-6 * power_});
  }
  void evaluate(std::uint32_t, const Frame& f) const override {
    // By the square, so that the little that is left in a tank does not become ever hotter.
    const double contact = across(f, kHeat, kContact);
    const double power = y(f, 0) * contact * contact;
    across(f, kPower) = power;
    through(f, kHeat) = power;
  }
  void derivative(const Frame& f) const override {
    const double wanted = across(f, kCommand) >= 0.5 ? across(f, kShare) : 0.0;
    const double share = fault(kStuck) == fault(kStuck) ? fault(kStuck) : wanted;
    dydt(f, 0) = (power_ * share * fault(kWeak) - y(f, 0)) / time_constant_;
  }

 private:
  double power_, time_constant_;
};

}  // namespace

ComponentType heater_type() {
  return {.name = "heater",
          .meaning = "gives heat to a tank, after it has become warm itself",
          .parameters = {{.name = "power",
                          .unit = "W",
                          .fallback = "",
                          .low = 1e-3,
                          .high = 1e9,
                          .meaning = "when it is fully on"},
                         {.name = "time_constant",
                          .unit = "s",
                          .fallback = "5 s",
                          .low = 1e-3,
                          .high = 1e5,
                          .meaning = "until it gives it"}},
          .ports = {{.name = "heat", .kind = PortKind::Heat, .reads = 0, .meaning = "what it heats"},
                    {.name = "command",
                     .kind = PortKind::Logic,
                     .open = Open::Constant,
                     .constant = 1.0,
                     .meaning = "on"},
                    {.name = "share",
                     .unit = "percent",
                     .open = Open::Constant,
                     .constant = 1.0,
                     .meaning = "of its power"},
                    {.name = "power_out",
                     .role = Role::Node,
                     .unit = "kW",
                     .open = Open::Fine,
                     .meaning = "that it gives"}},
          .faults = {{.name = "weak",
                      .unit = "",
                      .low = 0.0,
                      .high = 1.0,
                      .rest = 1.0,
                      .meaning = "it gives this share of its power"},
                     {.name = "stuck",
                      .unit = "",
                      .low = 0.0,
                      .high = 1.0,
                      .meaning = "it gives this share whatever it is told"}},
          .make = [](const Parameters& p) { return std::make_unique<Heater>(p); }};
}

}  // namespace stepwright::components::library

#include "plant_models/components/library/fault_specs.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

// How well a tank is mixed follows its agitator with one time constant, and is lost with another when it
// stands.
class Mixer final : public Component {
 public:
  explicit Mixer(const Parameters& p)
      : mixing_s_(p["mixing"]), settling_s_(p["settling"]), enough_(p["enough"]) {
    add_state({.tolerance = 1e-6});
    set_roots(1);
  }
  void evaluate(std::uint32_t, const Frame& f) const override {
    across(f, kMixed) = y(f, 0);
    across(f, kReady) = ready_ ? 1.0 : 0.0;
  }
  void derivative(const Frame& f) const override {
    const bool turns = across(f, kCommand) >= 0.5 && fault(0) < 0.5;
    dydt(f, 0) = turns ? (1.0 - y(f, 0)) / mixing_s_ : -y(f, 0) / settling_s_;
  }
  void roots(const Frame& f, double* g) const override { g[0] = y(f, 0) - enough_; }
  Event handle(const Frame&, const int* signs, double*) override {
    ready_ = signs[0] > 0;
    return Event::Changed;
  }

 private:
  enum Port : std::size_t { kCommand, kMixed, kReady };
  double mixing_s_, settling_s_, enough_;
  bool ready_ = false;
};

}  // namespace

ComponentType mixer_type() {
  return {.name = "mixer",
          .meaning = "an agitator: what is in the tank is mixed after a while",
          .parameters = {{.name = "mixing",
                          .unit = "s",
                          .fallback = "20 s",
                          .low = 1e-3,
                          .high = 1e6,
                          .meaning = "time constant while it turns"},
                         {.name = "settling",
                          .unit = "s",
                          .fallback = "600 s",
                          .low = 1e-3,
                          .high = 1e9,
                          .meaning = "time constant while it stands"},
                         {.name = "enough",
                          .unit = "percent",
                          .fallback = "95 percent",
                          .low = 0.01,
                          .high = 0.9999,
                          .meaning = "is mixed"}},
          .ports = {{.name = "command", .kind = PortKind::Logic, .meaning = "turns"},
                    {.name = "mixed",
                     .role = Role::Node,
                     .unit = "percent",
                     .open = Open::Fine,
                     .meaning = "how well"},
                    {.name = "ready",
                     .kind = PortKind::Logic,
                     .role = Role::Node,
                     .open = Open::Fine,
                     .meaning = "well enough"}},
          .faults = {flag_fault("stuck", "1: it does not turn")},
          .make = [](const Parameters& p) { return std::make_unique<Mixer>(p); }};
}

}  // namespace stepwright::components::library

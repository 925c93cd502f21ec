#include <cmath>

#include "plant_models/components/library/fault_specs.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kOf, kClosed, kContact };
enum Fault : std::size_t { kStuck };

// Closed while its signal is near a place; what it switches in the plant follows the true position, so that a
// switch that sticks misleads the program only.
class PositionSwitch final : public Component {
 public:
  explicit PositionSwitch(const Parameters& p)
      : at_(p["at"]), half_width_(p["half_width"]), hysteresis_(p["hysteresis"]) {
    set_roots(1, true);
  }
  void evaluate(std::uint32_t, const Frame& f) const override {
    across(f, kClosed) = closed_ ? 1.0 : 0.0;
    across(f, kContact) = fault(kStuck) == fault(kStuck) ? fault(kStuck) : across(f, kClosed);
  }
  void roots(const Frame& f, double* g) const override {
    g[0] = std::abs(across(f, kOf) - at_) - half_width_ - (closed_ ? hysteresis_ : 0.0);
  }
  Event handle(const Frame&, const int*, double*) override {
    closed_ = !closed_;
    return Event::Changed;
  }
  bool settle(const Frame& f) override {
    if (settled_) return false;
    settled_ = true;
    closed_ = std::abs(across(f, kOf) - at_) <= half_width_;
    return closed_;
  }

 private:
  double at_, half_width_, hysteresis_;
  bool closed_ = false;
  bool settled_ = false;
};

}  // namespace

ComponentType position_switch_type() {
  return {.name = "position_switch",
          .meaning = "a switch that is closed while something is at its place",
          .parameters = {{.name = "at", .unit = "m", .fallback = "", .meaning = "its place"},
                         {.name = "half_width",
                          .unit = "m",
                          .fallback = "0.03 m",
                          .low = 1e-6,
                          .high = 1e3,
                          .meaning = "it closes so near"},
                         {.name = "hysteresis",
                          .unit = "m",
                          .fallback = "0.001 m",
                          .low = 1e-9,
                          .high = 1e3,
                          .meaning = "and opens so much farther away"}},
          .ports =
              {{.name = "of", .unit = "m", .reads = kAtDerivative, .meaning = "the position that it watches"},
               {.name = "closed",
                .kind = PortKind::Logic,
                .role = Role::Node,
                .open = Open::Fine,
                .meaning = "something is there"},
               {.name = "contact",
                .kind = PortKind::Logic,
                .role = Role::Node,
                .open = Open::Fine,
                .meaning = "what the program sees of it"}},
          .faults = {contact_fault("stuck", "the program sees this whatever is there")},
          .make = [](const Parameters& p) { return std::make_unique<PositionSwitch>(p); }};
}

}  // namespace stepwright::components::library

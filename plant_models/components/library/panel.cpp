// What is on an operator's panel.

#include "plant_models/components/library/fault_specs.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

class PushButton final : public Component {
 public:
  explicit PushButton(const Parameters& p) : opens_(p.is("contact", "opens")) {}
  void evaluate(std::uint32_t, const Frame& f) const override {
    const bool pressed = fault(0) >= 0.5;
    const bool closed = fault(1) < 0.5 && pressed != opens_;
    across(f, 0) = closed ? 1.0 : 0.0;
  }

 private:
  bool opens_;
};

class Lamp final : public Component {
 public:
  void evaluate(std::uint32_t, const Frame& f) const override {
    across(f, 1) = across(f, 0) >= 0.5 && fault(0) < 0.5 ? 1.0 : 0.0;
  }
};

}  // namespace

ComponentType push_button_type() {
  return {.name = "push_button",
          .meaning = "a button that somebody presses by the command that sets faults",
          .parameters = {{.name = "contact",
                          .fallback = "closes",
                          .meaning = "what its contact does when it is pressed",
                          .choices = {"closes", "opens"}}},
          .ports = {{.name = "contact_out",
                     .kind = PortKind::Logic,
                     .role = Role::Node,
                     .open = Open::Fine,
                     .meaning = "what the program sees"}},
          .faults = {flag_fault("pressed", "1: somebody presses it (no fault)"),
                     flag_fault("broken_wire", "1: its wire is broken, whatever its contact does")},
          .make = [](const Parameters& p) { return std::make_unique<PushButton>(p); }};
}

ComponentType lamp_type() {
  return {.name = "lamp",
          .meaning = "a lamp",
          .parameters = {},
          .ports = {{.name = "command", .kind = PortKind::Logic, .reads = 0, .meaning = "on"},
                    {.name = "lit",
                     .kind = PortKind::Logic,
                     .role = Role::Node,
                     .open = Open::Fine,
                     .meaning = "it shines"}},
          .faults = {flag_fault("burnt_out", "1: it does not shine any more")},
          .make = [](const Parameters&) { return std::make_unique<Lamp>(); }};
}

}  // namespace stepwright::components::library

#include "plant_models/components/library/fault_specs.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kExtend, kRetract, kExtended, kRetracted, kPosition };
enum Fault : std::size_t { kStuck, kSlow, kExtendedShows, kRetractedShows };
constexpr double kSwitchAt = 0.02;  // of the stroke, before each end

class Cylinder final : public Component {
 public:
  explicit Cylinder(const Parameters& p)
      : stroke_(p["stroke"]),
        out_s_(p["extend_time"]),
        in_s_(p["retract_time"]),
        spring_(p.is("spring", "yes")) {
    add_state({.start = p.is("start", "extended") ? stroke_ : 0.0, .tolerance = 1e-7});
    set_roots(1);
  }
  void evaluate(std::uint32_t, const Frame& f) const override {
    const double share = y(f, 0) / stroke_;
    const auto shown = [&](std::size_t which, bool there) {
      return fault(which) == fault(which) ? fault(which) : there ? 1.0 : 0.0;
    };
    across(f, kPosition) = y(f, 0);
    across(f, kExtended) = shown(kExtendedShows, share >= 1.0 - kSwitchAt);
    across(f, kRetracted) = shown(kRetractedShows, share <= kSwitchAt);
  }
  void derivative(const Frame& f) const override {
    const double time = (direction_ > 0.0 ? out_s_ : in_s_) * fault(kSlow);
    dydt(f, 0) = direction_ * stroke_ / time;
  }
  void roots(const Frame& f, double* g) const override {
    const double left = direction_ > 0.0 ? stroke_ - y(f, 0) : y(f, 0);
    g[0] = direction_ == 0.0 ? 1.0 : left;
  }
  Event handle(const Frame&, const int* signs, double* all) override {
    if (signs[0] >= 0) return Event::None;
    state_of(all, 0) = direction_ > 0.0 ? stroke_ : 0.0;
    return Event::Restart;
  }
  // Both commands at once hold it, as both valves closed do.
  bool settle(const Frame& f) override {
    const bool extend = across(f, kExtend) >= 0.5;
    const bool retract = spring_ ? !extend : across(f, kRetract) >= 0.5;
    const bool out = extend && !retract && y(f, 0) < stroke_;
    const bool in = retract && !extend && y(f, 0) > 0.0;
    direction_ = fault(kStuck) >= 0.5 ? 0.0 : out ? 1.0 : in ? -1.0 : 0.0;
    return false;
  }

 private:
  double stroke_, out_s_, in_s_;
  bool spring_;
  double direction_ = 0.0;
};

}  // namespace

ComponentType cylinder_type() {
  return {.name = "cylinder",
          .meaning = "a pneumatic cylinder with a switch at each end",
          .parameters = {{.name = "stroke",
                          .unit = "m",
                          .fallback = "100 mm",
                          .low = 1e-4,
                          .high = 100.0,
                          .meaning = "from end to end"},
                         {.name = "extend_time",
                          .unit = "s",
                          .fallback = "0.5 s",
                          .low = 1e-3,
                          .high = 1e3,
                          .meaning = "of the whole stroke out"},
                         {.name = "retract_time",
                          .unit = "s",
                          .fallback = "0.5 s",
                          .low = 1e-3,
                          .high = 1e3,
                          .meaning = "of the whole stroke in"},
                         {.name = "spring",
                          .fallback = "no",
                          .meaning = "whether a spring retracts it",
                          .choices = {"no", "yes"}},
                         {.name = "start",
                          .fallback = "retracted",
                          .meaning = "at the start",
                          .choices = {"retracted", "extended"}}},
          .ports = {{.name = "extend", .kind = PortKind::Logic, .meaning = "air that pushes it out"},
                    {.name = "retract",
                     .kind = PortKind::Logic,
                     .open = Open::Constant,
                     .meaning = "air that pushes it in"},
                    {.name = "extended",
                     .kind = PortKind::Logic,
                     .role = Role::Node,
                     .open = Open::Fine,
                     .meaning = "its switch at the outer end, 2 percent before it"},
                    {.name = "retracted",
                     .kind = PortKind::Logic,
                     .role = Role::Node,
                     .open = Open::Fine,
                     .meaning = "its switch at the inner end"},
                    {.name = "position",
                     .role = Role::Node,
                     .unit = "mm",
                     .open = Open::Fine,
                     .meaning = "how far it is out"}},
          .faults = {flag_fault("stuck", "1: it stays where it is"),
                     {.name = "slow",
                      .low = 1.0,
                      .high = 1000.0,
                      .rest = 1.0,
                      .meaning = "it takes so many times its time"},
                     contact_fault("stuck_extended", "the switch at the outer end shows this"),
                     contact_fault("stuck_retracted", "the switch at the inner end shows this")},
          .make = [](const Parameters& p) { return std::make_unique<Cylinder>(p); }};
}

}  // namespace stepwright::components::library

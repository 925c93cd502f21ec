#include <algorithm>

#include "plant_models/components/library/fault_specs.h"
#include "plant_models/components/library/fluid.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kIn, kOut, kCommand, kOpened, kClosed, kPosition, kFlowOut };
enum Fault : std::size_t { kStuck, kBlocked, kSlow, kOpenedShows, kClosedShows };
constexpr double kBar = 1e5;
constexpr double kSwitchAt = 0.02;  // of the travel, before each end

bool holds(double fault) {
  return fault == fault;
}

class OnOffValve final : public Through {
 public:
  explicit OnOffValve(const Parameters& p) : Through(kIn, kOut), full_(p["kv"]), travel_(p["travel"]) {
    add_state({.start = p.is("start", "open") ? 1.0 : 0.0, .tolerance = 1e-6});
    set_roots(1);
  }

  void evaluate(std::uint32_t stage, const Frame& f) const override {
    const double position = y(f, 0);
    if (stage == 0) {
      across(f, kPosition) = position;
      across(f, kOpened) = holds(fault(kOpenedShows))    ? fault(kOpenedShows)
                           : position >= 1.0 - kSwitchAt ? 1.0
                                                         : 0.0;
      across(f, kClosed) = holds(fault(kClosedShows)) ? fault(kClosedShows)
                           : position <= kSwitchAt    ? 1.0
                                                      : 0.0;
      return;
    }
    const double opening = std::clamp(position, 0.0, 1.0) * (1.0 - fault(kBlocked));
    across(f, kFlowOut) = set_flow(f, turbulent(full_ * opening, pressure_drop(f) / kBar));
  }
  void derivative(const Frame& f) const override { dydt(f, 0) = direction_ / (travel_ * fault(kSlow)); }

  // It arrives at the end that it moves to.
  void roots(const Frame& f, double* g) const override {
    const double left = direction_ > 0.0 ? 1.0 - y(f, 0) : y(f, 0);
    g[0] = direction_ == 0.0 ? 1.0 : left;
  }
  Event handle(const Frame&, const int* signs, double* all) override {
    if (signs[0] >= 0) return Event::None;
    state_of(all, 0) = direction_ > 0.0 ? 1.0 : 0.0;
    return Event::Restart;
  }
  bool settle(const Frame& f) override {
    const double wanted = across(f, kCommand) >= 0.5 ? 1.0 : 0.0;
    const double away = wanted - y(f, 0);
    const bool moves = fault(kStuck) < 0.5 && away != 0.0;
    direction_ = !moves ? 0.0 : away > 0.0 ? 1.0 : -1.0;
    return false;
  }

 private:
  double full_, travel_;
  double direction_ = 0.0;
};

}  // namespace

ComponentType on_off_valve_type() {
  return {
      .name = "on_off_valve",
      .meaning = "a valve that is driven open or closed at constant speed, with a switch at each end",
      .parameters = {{.name = "kv",
                      .unit = "m3/s",
                      .fallback = "",
                      .low = 1e-12,
                      .high = 1e3,
                      .meaning = "flow of water at 1 bar, fully open"},
                     {.name = "travel",
                      .unit = "s",
                      .fallback = "2 s",
                      .low = 1e-3,
                      .high = 1e4,
                      .meaning = "from end to end"},
                     {.name = "start",
                      .unit = "",
                      .fallback = "closed",
                      .meaning = "at the start",
                      .choices = {"closed", "open"}}},
      .ports = {{.name = "in", .kind = PortKind::Fluid, .stage = 1, .reads = 1, .meaning = "one end"},
                {.name = "out", .kind = PortKind::Fluid, .stage = 1, .reads = 1, .meaning = "the other end"},
                {.name = "command", .kind = PortKind::Logic, .meaning = "open"},
                {.name = "opened",
                 .kind = PortKind::Logic,
                 .role = Role::Node,
                 .open = Open::Fine,
                 .meaning = "its switch at the open end, 2 percent before it"},
                {.name = "closed",
                 .kind = PortKind::Logic,
                 .role = Role::Node,
                 .open = Open::Fine,
                 .meaning = "its switch at the closed end"},
                {.name = "position",
                 .role = Role::Node,
                 .unit = "percent",
                 .open = Open::Fine,
                 .meaning = "0 closed, 100 open"},
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
                 {.name = "slow",
                  .unit = "",
                  .low = 1.0,
                  .high = 1000.0,
                  .rest = 1.0,
                  .meaning = "it takes so many times its travel time",
                  .usual = 10.0},
                 contact_fault("stuck_opened", "the switch at the open end shows this"),
                 contact_fault("stuck_closed", "the switch at the closed end shows this")},
      .stages = 2,
      .make = [](const Parameters& p) { return std::make_unique<OnOffValve>(p); }};
}

}  // namespace stepwright::components::library

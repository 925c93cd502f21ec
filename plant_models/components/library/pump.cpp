#include <algorithm>
#include <limits>

#include "plant_models/components/library/fluid.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kIn, kOut, kCommand, kSpeedCommand, kJoined, kSpeed, kFlowOut, kDelivered };
enum Fault : std::size_t { kWeak, kStuck, kExtra };
enum State : std::size_t { kTurning, kTotal };
constexpr double kNever = std::numeric_limits<double>::infinity();

class Pump final : public Through {
 public:
  explicit Pump(const Parameters& p)
      : Through(kIn, kOut),
        head_(p["head"]),
        resistance_(p["resistance"]),
        lift_(p["lift"]),
        time_constant_(p["spin_up"]),
        weight_(p.weight()),
        free_(p.is("outlet", "free")),
        counts_(p.is("totaliser", "yes")) {
    add_state({.tolerance = 1e-6});
    if (!counts_) return;
    add_state({.tolerance = 1e-9});
    set_roots(1);
  }

  void evaluate(std::uint32_t stage, const Frame& f) const override {
    const double turning = y(f, kTurning);
    if (stage == 0) {
      across(f, kSpeed) = turning;
      across(f, kDelivered) = counts_ ? y(f, kTotal) : 0.0;
      return;
    }
    const double from = across(f, kIn, kPressure) / weight_;
    const double to = free_ ? 0.0 : across(f, kOut, kPressure) / weight_;
    const double surplus = head_ * turning * turning - (lift_ + to - from);
    const bool flows = surplus > 0.0 && across(f, kJoined) >= 0.5;
    across(f, kFlowOut) = set_flow(f, flows ? surplus / resistance_ * fault(kWeak) : 0.0);
  }

  void derivative(const Frame& f) const override {
    dydt(f, kTurning) = (wanted(f) - y(f, kTurning)) / time_constant_;
    if (counts_) dydt(f, kTotal) = across(f, kFlowOut);
  }

  void roots(const Frame& f, double* g) const override {
    g[0] = until_ < kNever ? y(f, kTotal) - until_ : -1.0;
  }
  Event handle(const Frame&, const int* signs, double*) override {
    if (signs[0] <= 0) return Event::None;
    until_ = kNever;
    return Event::Restart;
  }
  void fault_changed(std::size_t fault, double value, const Frame& f) override {
    if (fault == kExtra) until_ = counts_ && value > 0.0 ? y(f, kTotal) + value : kNever;
  }

 private:
  double wanted(const Frame& f) const {
    if (fault(kStuck) == fault(kStuck)) return fault(kStuck);
    return until_ < kNever || across(f, kCommand) >= 0.5 ? across(f, kSpeedCommand) : 0.0;
  }

  double head_, resistance_, lift_, time_constant_, weight_;
  bool free_, counts_;
  double until_ = kNever;  // total at which an extra draw ends
};

}  // namespace

ComponentType pump_type() {
  return {
      .name = "pump",
      .meaning =
          "a centrifugal pump with the line behind it: it spins up and runs down; a check valve lets nothing "
          "back",
      .parameters = {{.name = "head",
                      .unit = "m",
                      .fallback = "",
                      .low = 1e-3,
                      .high = 1e4,
                      .meaning = "against a closed valve, at nominal speed"},
                     {.name = "resistance",
                      .unit = "m/(m3/s)",
                      .fallback = "",
                      .low = 1e-6,
                      .high = 1e12,
                      .meaning = "head lost per flow"},
                     {.name = "lift",
                      .unit = "m",
                      .fallback = "0 m",
                      .low = -1e3,
                      .high = 1e3,
                      .meaning = "highest point of its line above the bottom of the tank it sucks from"},
                     {.name = "spin_up",
                      .unit = "s",
                      .fallback = "0.25 s",
                      .low = 1e-3,
                      .high = 1e3,
                      .meaning = "time constant of its speed"},
                     {.name = "outlet",
                      .unit = "",
                      .fallback = "submerged",
                      .meaning = "submerged: against the pressure at its end; free: it falls into the open",
                      .choices = {"submerged", "free"}},
                     {.name = "totaliser",
                      .unit = "",
                      .fallback = "no",
                      .meaning = "whether it counts what it has delivered",
                      .choices = {"no", "yes"}}},
      .ports =
          {{.name = "in", .kind = PortKind::Fluid, .stage = 1, .reads = 1, .meaning = "where it sucks from"},
           {.name = "out",
            .kind = PortKind::Fluid,
            .stage = 1,
            .reads = 1,
            .meaning = "where it delivers to"},
           {.name = "command", .kind = PortKind::Logic, .meaning = "on"},
           {.name = "speed",
            .unit = "percent",
            .open = Open::Constant,
            .constant = 1.0,
            .meaning = "of nominal, while it is on"},
           {.name = "while",
            .kind = PortKind::Logic,
            .reads = 1,
            .open = Open::Constant,
            .constant = 1.0,
            .meaning = "its line is joined only while this is true"},
           {.name = "turning",
            .role = Role::Node,
            .unit = "",
            .open = Open::Fine,
            .meaning = "its speed; 1 = nominal"},
           {.name = "flow",
            .role = Role::Node,
            .unit = "l/s",
            .stage = 1,
            .open = Open::Fine,
            .meaning = "what it delivers"},
           {.name = "delivered",
            .role = Role::Node,
            .unit = "l",
            .open = Open::Fine,
            .meaning = "so far, with a totaliser",
            .needs = {"totaliser", "yes"}}},
      .faults = {{.name = "weak",
                  .unit = "",
                  .low = 0.0,
                  .high = 1.0,
                  .rest = 1.0,
                  .meaning = "it delivers this share of its flow"},
                 {.name = "stuck",
                  .unit = "",
                  .low = 0.0,
                  .high = 1.0,
                  .meaning = "it runs at this speed whatever it is told; 0 = it stands"},
                 {.name = "extra",
                  .unit = "l",
                  .low = 0.0,
                  .high = 1e6,
                  .rest = 0.0,
                  .meaning = "with a totaliser: it delivers this much whatever it is told",
                  .usual = 10.0,
                  .needs = {"totaliser", "yes"}}},
      .stages = 2,
      .make = [](const Parameters& p) { return std::make_unique<Pump>(p); }};
}

}  // namespace stepwright::components::library

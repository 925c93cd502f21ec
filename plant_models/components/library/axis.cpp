#include <algorithm>
#include <cmath>

#include "plant_models/components/library/fault_specs.h"
#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kEnable, kTarget, kPosition, kSpeed, kThere };
enum Fault : std::size_t { kStuck, kSlow };

// A positioning axis: a position loop around a speed loop, with limits of speed and acceleration.
class Axis final : public Component {
 public:
  explicit Axis(const Parameters& p)
      : top_(p["top_speed"]),
        most_(p["acceleration"]),
        gain_(p["gain"]),
        near_(p["in_position"]),
        low_(p["low"]),
        high_(p["high"]) {
    add_state({.start = p["start"], .tolerance = 1e-7});
    add_state({.tolerance = 1e-7});
  }
  void evaluate(std::uint32_t, const Frame& f) const override {
    across(f, kPosition) = y(f, 0);
    across(f, kSpeed) = y(f, 1);
    across(f, kThere) = std::abs(target(f) - y(f, 0)) <= near_ ? 1.0 : 0.0;
  }
  void derivative(const Frame& f) const override {
    const bool on = across(f, kEnable) >= 0.5 && fault(kStuck) < 0.5;
    const double away = target(f) - y(f, 0);
    // No faster than it can brake from.
    const double top = top_ / fault(kSlow);
    const double braking = std::sqrt(2.0 * 0.8 * most_ * std::abs(away));
    const double speed = on ? std::clamp(gain_ * away, -std::min(top, braking), std::min(top, braking)) : 0.0;
    dydt(f, 0) = y(f, 1);
    dydt(f, 1) = std::clamp(4.0 * gain_ * (speed - y(f, 1)), -most_, most_);
  }

 private:
  double target(const Frame& f) const { return std::clamp(across(f, kTarget), low_, high_); }
  double top_, most_, gain_, near_, low_, high_;
};

}  // namespace

ComponentType axis_type() {
  return {
      .name = "axis",
      .meaning = "a linear axis with its servo drive: goes to a position within its speed and acceleration",
      .parameters = {{.name = "top_speed",
                      .unit = "m/s",
                      .fallback = "0.5 m/s",
                      .low = 1e-6,
                      .high = 100.0,
                      .meaning = "at most"},
                     {.name = "acceleration",
                      .unit = "m/s2",
                      .fallback = "2 m/s2",
                      .low = 1e-6,
                      .high = 1e3,
                      .meaning = "at most"},
                     {.name = "gain",
                      .unit = "1/s",
                      .fallback = "10 1/s",
                      .low = 1e-3,
                      .high = 1e3,
                      .meaning = "of its position loop"},
                     {.name = "in_position",
                      .unit = "m",
                      .fallback = "0.5 mm",
                      .low = 1e-7,
                      .high = 1.0,
                      .meaning = "so near is there"},
                     {.name = "low",
                      .unit = "m",
                      .fallback = "0 m",
                      .low = -1e4,
                      .high = 1e4,
                      .meaning = "its lowest position"},
                     {.name = "high",
                      .unit = "m",
                      .fallback = "1 m",
                      .low = -1e4,
                      .high = 1e4,
                      .meaning = "its highest position"},
                     {.name = "start",
                      .unit = "m",
                      .fallback = "0 m",
                      .low = -1e4,
                      .high = 1e4,
                      .meaning = "position at the start"}},
      .ports = {{.name = "enable", .kind = PortKind::Logic, .meaning = "the drive is on; else it brakes"},
                {.name = "target", .unit = "mm", .reads = 0, .meaning = "where it is to go"},
                {.name = "position",
                 .role = Role::Node,
                 .unit = "mm",
                 .open = Open::Fine,
                 .meaning = "where it is"},
                {.name = "speed",
                 .role = Role::Node,
                 .unit = "mm/s",
                 .open = Open::Fine,
                 .meaning = "how fast it is"},
                {.name = "there",
                 .kind = PortKind::Logic,
                 .role = Role::Node,
                 .open = Open::Fine,
                 .meaning = "in position"}},
      .faults = {flag_fault("stuck", "1: it stands"),
                 {.name = "slow",
                  .low = 1.0,
                  .high = 1000.0,
                  .rest = 1.0,
                  .meaning = "its top speed is so many times lower"}},
      .make = [](const Parameters& p) { return std::make_unique<Axis>(p); }};
}

}  // namespace stepwright::components::library

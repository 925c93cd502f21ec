#include "plant_models/components/library/types.h"

#include <algorithm>

namespace stepwright::components::library {
namespace {

enum Port : std::size_t { kLeft, kRight, kLoad, kLoading, kPosition, kSpeed };
enum Fault : std::size_t { kWeak };
enum State : std::size_t { kX, kV };

// A vehicle on a track with dry friction, a brake and end stops (plant_models/doc/bench.md, "Motion").
class Carriage final : public Component {
 public:
  explicit Carriage(const Parameters& p)
      : mass_(p["mass"]),
        force_(p["force"]),
        viscous_(p["viscous_friction"]),
        coulomb_(p["coulomb_friction"]),
        static_(p["static_friction"]),
        brake_(p["brake"]),
        end_stop_(p["end_stop"]),
        density_(p.density_kg_m3) {
    add_state({.start = p["start"], .tolerance = 1e-7});
    add_state({.tolerance = 1e-7});
    set_roots(2);
  }

  void evaluate(std::uint32_t, const Frame& f) const override {
    across(f, kPosition) = y(f, kX);
    across(f, kSpeed) = y(f, kV);
  }
  void derivative(const Frame& f) const override {
    dydt(f, kX) = direction_ != 0 ? y(f, kV) : 0.0;
    dydt(f, kV) = direction_ != 0 ? acceleration(f) : 0.0;
  }
  void roots(const Frame& f, double* g) const override {
    g[0] = direction_ != 0 ? direction_ * y(f, kV) : 1.0;
    g[1] = direction_ != 0 ? end_stop_ - direction_ * y(f, kX) : 1.0;
  }
  Event handle(const Frame&, const int* signs, double* all) override {
    if (signs[1] < 0) state_of(all, kX) = direction_ * end_stop_;
    if (signs[0] >= 0 && signs[1] >= 0) return Event::None;
    state_of(all, kV) = 0.0;
    return Event::Restart;
  }
  bool settle(const Frame& f) override {
    drive_ = (across(f, kRight) >= 0.5 ? 1 : 0) - (across(f, kLeft) >= 0.5 ? 1 : 0);
    direction_ = direction_from(y(f, kX), y(f, kV));
    return false;
  }

 private:
  double acceleration(const Frame& f) const {
    const double mass = mass_ + density_ * std::max(0.0, across(f, kLoad));
    const double brake = drive_ == 0 ? brake_ : 0.0;
    const double force = drive_ * force_ * fault(kWeak) - direction_ * (coulomb_ + brake) -
                         (viscous_ + density_ * across(f, kLoading)) * y(f, kV);
    return force / mass;
  }
  int direction_from(double x, double speed) const {
    if (speed > 0.0) return 1;
    if (speed < 0.0) return -1;
    const bool held = drive_ == 0 || force_ * fault(kWeak) <= static_;
    const bool blocked = drive_ * x >= end_stop_;
    return held || blocked ? 0 : drive_;
  }

  double mass_, force_, viscous_, coulomb_, static_, brake_, end_stop_, density_;
  int drive_ = 0;      // -1 left, 0 braked, +1 right
  int direction_ = 0;  // of motion; 0 = held
};

}  // namespace

ComponentType carriage_type() {
  return {
      .name = "carriage",
      .meaning = "a vehicle on a straight track, driven left or right, braked otherwise, with end stops",
      .parameters =
          {{.name = "mass", .unit = "kg", .fallback = "", .low = 1e-6, .high = 1e7, .meaning = "empty"},
           {.name = "force",
            .unit = "N",
            .fallback = "",
            .low = 1e-6,
            .high = 1e9,
            .meaning = "of its drive"},
           {.name = "viscous_friction",
            .unit = "N/(m/s)",
            .fallback = "10 N/(m/s)",
            .low = 0.0,
            .high = 1e9,
            .meaning = "per speed"},
           {.name = "coulomb_friction",
            .unit = "N",
            .fallback = "0 N",
            .low = 0.0,
            .high = 1e9,
            .meaning = "while it moves"},
           {.name = "static_friction",
            .unit = "N",
            .fallback = "0 N",
            .low = 0.0,
            .high = 1e9,
            .meaning = "that its drive has to overcome"},
           {.name = "brake",
            .unit = "N",
            .fallback = "0 N",
            .low = 0.0,
            .high = 1e9,
            .meaning = "while it is driven in no single direction"},
           {.name = "start",
            .unit = "m",
            .fallback = "0 m",
            .low = -1e5,
            .high = 1e5,
            .meaning = "position at the start"},
           {.name = "end_stop",
            .unit = "m",
            .fallback = "1 m",
            .low = 1e-4,
            .high = 1e5,
            .meaning = "stops are at + and - this"}},
      .ports = {{.name = "left", .kind = PortKind::Logic, .meaning = "drives towards negative positions"},
                {.name = "right", .kind = PortKind::Logic, .meaning = "drives towards positive positions"},
                {.name = "load", .unit = "l", .open = Open::Constant, .meaning = "liquid that it carries"},
                {.name = "loading",
                 .unit = "l/s",
                 .open = Open::Constant,
                 .meaning = "liquid that flows into it, which it has to bring to its speed"},
                {.name = "position",
                 .role = Role::Node,
                 .unit = "m",
                 .open = Open::Fine,
                 .meaning = "on the track"},
                {.name = "velocity",
                 .role = Role::Node,
                 .unit = "m/s",
                 .open = Open::Fine,
                 .meaning = "positive to the right"}},
      .faults = {{.name = "weak",
                  .unit = "",
                  .low = 0.0,
                  .high = 1.0,
                  .rest = 1.0,
                  .meaning = "its drive has this share of its force"}},
      .make = [](const Parameters& p) { return std::make_unique<Carriage>(p); }};
}

}  // namespace stepwright::components::library

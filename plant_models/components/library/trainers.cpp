// Plants that controllers are tuned on.

#include <algorithm>
#include <cmath>

#include "plant_models/components/library/types.h"

namespace stepwright::components::library {
namespace {

// T dy/dt = K u(t - L) - y. The dead time is a line of samples: what goes in at one comes out L later.
class FirstOrder final : public Component {
 public:
  explicit FirstOrder(const Parameters& p)
      : gain_(p["gain"]), time_constant_(p["time_constant"]), offset_(p["offset"]), dead_s_(p["dead_time"]) {
    add_state({.start = p["start"] - offset_, .tolerance = 1e-7});
    if (dead_s_ <= 0.0) return;
    const double samples = std::clamp(std::ceil(dead_s_ / p["sample"]), 1.0, 10'000.0);
    line_.assign(static_cast<std::size_t>(samples), 0.0);
    step_s_ = dead_s_ / samples;
    next_s_ = step_s_;
    set_roots(1);
  }
  void evaluate(std::uint32_t, const Frame& f) const override {
    across(f, kValue) = y(f, 0) + offset_ + fault(0);
  }
  void derivative(const Frame& f) const override {
    const double input = line_.empty() ? across(f, kInput) : line_[at_];
    dydt(f, 0) = (gain_ * input - y(f, 0)) / time_constant_;
  }
  void roots(const Frame& f, double* g) const override { g[0] = f.t_s - next_s_; }
  Event handle(const Frame& f, const int*, double*) override {
    line_[at_] = across(f, kInput);
    at_ = (at_ + 1) % line_.size();
    ++ticks_;
    next_s_ = step_s_ * static_cast<double>(ticks_ + 1);
    return Event::Changed;
  }

 private:
  enum Port : std::size_t { kInput, kValue };
  double gain_, time_constant_, offset_, dead_s_;
  double step_s_ = 0.0, next_s_ = 0.0;
  std::int64_t ticks_ = 0;
  std::vector<double> line_;
  std::size_t at_ = 0;
};

// Two tanks in a row that empty by Torricelli's law: A dh/dt = q_in - a sqrt(2 g h).
class DoubleTank final : public Component {
 public:
  explicit DoubleTank(const Parameters& p)
      : section_(p["section"]), outlet_(p["outlet"]), flow_(p["flow"]), gravity_(p.gravity_m_s2) {
    add_state({.start = p["start"], .tolerance = 1e-8});
    add_state({.start = p["start"], .tolerance = 1e-8});
  }
  void evaluate(std::uint32_t, const Frame& f) const override {
    across(f, kUpper) = y(f, 0);
    across(f, kLower) = y(f, 1);
  }
  void derivative(const Frame& f) const override {
    const double between = outflow(y(f, 0)) * (1.0 - fault(0));
    dydt(f, 0) = (flow_ * std::clamp(across(f, kShare), 0.0, 1.0) - between) / section_;
    dydt(f, 1) = (between - outflow(y(f, 1))) / section_;
  }

 private:
  enum Port : std::size_t { kShare, kLower, kUpper };
  // Linear below a tenth of a millimetre, where the root is too steep.
  double outflow(double height) const {
    constexpr double kLittle = 1e-4;
    const double speed = height > kLittle
                             ? std::sqrt(2.0 * gravity_ * height)
                             : std::sqrt(2.0 * gravity_ * kLittle) * std::max(0.0, height) / kLittle;
    return outlet_ * speed;
  }
  double section_, outlet_, flow_, gravity_;
};

// A rod on a cart (K. J. Astrom, R. M. Murray, "Feedback Systems", example 3.2): angle 0 = upright.
class Pendulum final : public Component {
 public:
  explicit Pendulum(const Parameters& p)
      : cart_(p["cart_mass"]),
        rod_(p["rod_mass"]),
        length_(p["length"]),
        cart_friction_(p["cart_friction"]),
        rod_friction_(p["rod_friction"]),
        force_(p["force"]),
        gravity_(p.gravity_m_s2) {
    add_state({.tolerance = 1e-8});
    add_state({.tolerance = 1e-8});
    add_state({.start = p["start_angle"], .tolerance = 1e-8});
    add_state({.tolerance = 1e-8});
  }
  void evaluate(std::uint32_t, const Frame& f) const override {
    across(f, kPosition) = y(f, 0);
    across(f, kAngle) = y(f, 2);
    const double v = y(f, 1), w = y(f, 3), c = std::cos(y(f, 2));
    across(f, kEnergy) = 0.5 * (cart_ + rod_) * v * v - rod_ * length_ * v * w * c +
                         0.5 * rod_ * length_ * length_ * w * w + rod_ * gravity_ * length_ * c;
  }
  // (M + m) a - m l cos(q) e = F - c v - m l sin(q) w^2;  m l^2 e - m l cos(q) a = m g l sin(q) - g_r w.
  void derivative(const Frame& f) const override {
    const double v = y(f, 1), w = y(f, 3), s = std::sin(y(f, 2)), c = std::cos(y(f, 2));
    const double ml = rod_ * length_;
    const double push = force_ * std::clamp(across(f, kShare), -1.0, 1.0) * (1.0 - fault(0)) -
                        cart_friction_ * v - ml * s * w * w;
    const double turn = ml * gravity_ * s - rod_friction_ * w;
    const double a11 = cart_ + rod_, a12 = -ml * c, a22 = ml * length_;
    const double determinant = a11 * a22 - a12 * a12;
    dydt(f, 0) = v;
    dydt(f, 1) = (push * a22 - a12 * turn) / determinant;
    dydt(f, 2) = w;
    dydt(f, 3) = (a11 * turn - a12 * push) / determinant;
  }

 private:
  enum Port : std::size_t { kShare, kPosition, kAngle, kEnergy };
  double cart_, rod_, length_, cart_friction_, rod_friction_, force_, gravity_;
};

}  // namespace

ComponentType first_order_type() {
  return {.name = "first_order",
          .meaning = "follows its input with a gain, a time constant and a dead time",
          .parameters = {{.name = "gain",
                          .fallback = "1",
                          .low = -1e9,
                          .high = 1e9,
                          .meaning = "value per input, when it has settled"},
                         {.name = "time_constant",
                          .unit = "s",
                          .fallback = "10 s",
                          .low = 1e-3,
                          .high = 1e6,
                          .meaning = "63 percent of a step"},
                         {.name = "dead_time",
                          .unit = "s",
                          .fallback = "0 s",
                          .low = 0.0,
                          .high = 1e5,
                          .meaning = "before it begins"},
                         {.name = "sample",
                          .unit = "s",
                          .fallback = "10 ms",
                          .low = 1e-4,
                          .high = 1e3,
                          .meaning = "of the dead time: how finely it is cut"},
                         {.name = "offset", .fallback = "0", .meaning = "value without an input"},
                         {.name = "start", .fallback = "0", .meaning = "value at the start"}},
          .ports = {{.name = "input", .unit = "percent", .meaning = "what drives it"},
                    {.name = "value",
                     .role = Role::Node,
                     .unit = "percent",
                     .open = Open::Fine,
                     .meaning = "how it answers"}},
          .faults = {{.name = "disturbance",
                      .unit = "percent",
                      .low = -1e6,
                      .high = 1e6,
                      .rest = 0.0,
                      .meaning = "is added to its value",
                      .usual = 50.0}},
          .make = [](const Parameters& p) { return std::make_unique<FirstOrder>(p); }};
}

ComponentType double_tank_type() {
  return {.name = "double_tank",
          .meaning = "two tanks above each other: the upper one runs into the lower one",
          .parameters = {{.name = "section",
                          .unit = "m2",
                          .fallback = "0.01 m2",
                          .low = 1e-8,
                          .high = 1e4,
                          .meaning = "of each tank"},
                         {.name = "outlet",
                          .unit = "m2",
                          .fallback = "0.5 cm2",
                          .low = 1e-10,
                          .high = 1.0,
                          .meaning = "opening of each tank"},
                         {.name = "flow",
                          .unit = "m3/s",
                          .fallback = "0.1 l/s",
                          .low = 1e-12,
                          .high = 1e3,
                          .meaning = "that flows in at 100 percent"},
                         {.name = "start",
                          .unit = "m",
                          .fallback = "0 m",
                          .low = 0.0,
                          .high = 1e3,
                          .meaning = "height of the liquid in both at the start"}},
          .ports = {{.name = "inflow", .unit = "percent", .meaning = "share of the flow"},
                    {.name = "lower",
                     .role = Role::Node,
                     .unit = "cm",
                     .open = Open::Fine,
                     .meaning = "height of the liquid in the lower tank"},
                    {.name = "upper",
                     .role = Role::Node,
                     .unit = "cm",
                     .open = Open::Fine,
                     .meaning = "height of the liquid in the upper tank"}},
          .faults = {{.name = "blocked",
                      .unit = "percent",
                      .low = 0.0,
                      .high = 100.0,
                      .rest = 0.0,
                      .meaning = "by this much less runs out of the upper tank"}},
          .make = [](const Parameters& p) { return std::make_unique<DoubleTank>(p); }};
}

ComponentType pendulum_type() {
  return {.name = "pendulum",
          .meaning = "a rod that stands on a cart, which a force moves",
          .parameters = {{.name = "cart_mass",
                          .unit = "kg",
                          .fallback = "1 kg",
                          .low = 1e-3,
                          .high = 1e6,
                          .meaning = "of the cart"},
                         {.name = "rod_mass",
                          .unit = "kg",
                          .fallback = "0.1 kg",
                          .low = 1e-4,
                          .high = 1e6,
                          .meaning = "at its end"},
                         {.name = "length",
                          .unit = "m",
                          .fallback = "0.5 m",
                          .low = 1e-3,
                          .high = 1e3,
                          .meaning = "of the rod"},
                         {.name = "cart_friction",
                          .unit = "N/(m/s)",
                          .fallback = "0.1 N/(m/s)",
                          .low = 0.0,
                          .high = 1e6,
                          .meaning = "per speed"},
                         {.name = "rod_friction",
                          .unit = "N m s",
                          .fallback = "0.001 N m s",
                          .low = 0.0,
                          .high = 1e6,
                          .meaning = "per speed of turning"},
                         {.name = "force",
                          .unit = "N",
                          .fallback = "10 N",
                          .low = 1e-6,
                          .high = 1e9,
                          .meaning = "at 100 percent"},
                         {.name = "start_angle",
                          .fallback = "1 degree",
                          .meaning = "at the start; 0 is upright"}},
          .ports =
              {{.name = "push",
                .unit = "percent",
                .open = Open::Constant,
                .meaning = "share of the force, -100 to 100 percent"},
               {.name = "position",
                .role = Role::Node,
                .unit = "m",
                .open = Open::Fine,
                .meaning = "of the cart"},
               {.name = "angle",
                .role = Role::Node,
                .unit = "degree",
                .open = Open::Fine,
                .meaning = "of the rod; 0 is upright"},
               {.name = "energy", .role = Role::Node, .unit = "J", .open = Open::Fine, .meaning = "of both"}},
          .faults = {{.name = "weak",
                      .unit = "percent",
                      .low = 0.0,
                      .high = 100.0,
                      .rest = 0.0,
                      .meaning = "by this much less it is pushed"}},
          .make = [](const Parameters& p) { return std::make_unique<Pendulum>(p); }};
}

}  // namespace stepwright::components::library

#include "tests/bench/plant/bench_rk4.h"

#include <algorithm>
#include <cmath>

namespace stepwright::bench {
namespace {

// s + h * k, component by component.
HandState along(const HandState& s, double h, const HandState& k) {
  HandState r;
  r.x = s.x + h * k.x;
  r.v = s.v + h * k.v;
  r.sump = s.sump + h * k.sump;
  for (std::size_t i = 0; i < 4; ++i) {
    r.volume[i] = s.volume[i] + h * k.volume[i];
    r.w[i] = s.w[i] + h * k.w[i];
  }
  return r;
}

}  // namespace

HandBench::HandBench(const assemblies::BenchParameters& parameters) : p_(parameters) {
  state_.x = p_.vehicle.initial_position_m;
  for (std::size_t i = 0; i < 4; ++i) {
    state_.volume[i] = p_.tanks[i].capacity_l * 1e-3 * p_.tanks[i].initial_percent / 100.0;
  }
  settle(0.0);
}

double HandBench::percent(std::size_t tank) const {
  return 100.0 * state_.volume[tank] / (p_.tanks[tank].capacity_l * 1e-3);
}

HandState HandBench::slope(const HandState& s) const {
  HandState d;
  std::array<double, 4> height{}, open{};
  for (std::size_t i = 0; i < 4; ++i) {
    const double full = p_.tanks[i].capacity_l * 1e-3;
    height[i] = s.volume[i] / full * p_.tanks[i].height_m;
    open[i] = std::clamp(s.volume[i] / (full * p_.suction_percent / 100.0), 0.0, 1.0);
    const double leak = leak_m3_s[i] * open[i];
    d.volume[i] -= leak;
    d.sump += leak;
    if (i == 0) continue;
    const double over = p_.overflow_rate_per_s * std::max(0.0, s.volume[i] - full);
    d.volume[i] -= over;
    d.volume[0] += over;
  }
  const auto pump = [&](std::size_t i, double target_height) {
    const auto& pp = p_.pumps[i];
    const double head = pp.shutoff_head_m * s.w[i] * s.w[i] - (pp.lift_m + target_height - height[i]);
    return std::max(0.0, head) / pp.resistance_m_per_m3_s * open[i];
  };
  const double load = place_ == 0 ? pump(0, height[1]) : 0.0;
  d.volume[0] -= load;
  d.volume[1] += load;
  const double unload = pump(1, place_ == 1 ? height[2] : place_ == 2 ? height[3] : 0.0);
  d.volume[1] -= unload;
  (place_ == 1 ? d.volume[2] : place_ == 2 ? d.volume[3] : d.sump) += unload;
  for (std::size_t i = 2; i < 4; ++i) {
    const double draw = pump(i, 0.0);
    d.volume[i] -= draw;
    d.volume[0] += draw;
  }
  for (std::size_t i = 0; i < 4; ++i)
    d.w[i] = ((inputs.pump[i] ? 1.0 : 0.0) - s.w[i]) / p_.pumps[i].time_constant_s;
  if (direction_ != 0) {
    const auto& c = p_.vehicle;
    const double mass = c.empty_mass_kg + p_.density_kg_per_l * 1e3 * s.volume[1];
    const double dry = c.coulomb_friction_n + (inputs.drive == 0 ? c.brake_force_n : 0.0);
    const double wet = c.viscous_friction_n_per_m_s + p_.density_kg_per_l * 1e3 * load;
    d.x = s.v;
    d.v = (inputs.drive * c.drive_force_n - direction_ * dry - wet * s.v) / mass;
  }
  return d;
}

void HandBench::settle(double speed_before) {
  const auto& t = p_.track;
  if (direction_ != 0 && state_.v * direction_ <= 0.0 && speed_before != 0.0) state_.v = 0.0;
  if (std::abs(state_.x) >= t.end_stop_m && state_.v * state_.x > 0.0) {
    state_.x = std::copysign(t.end_stop_m, state_.x);
    state_.v = 0.0;
  }
  direction_ = state_.v > 0.0 ? 1 : state_.v < 0.0 ? -1 : inputs.drive;
  if (state_.v == 0.0 && inputs.drive * state_.x >= t.end_stop_m) direction_ = 0;
  for (int i = 0; i < 3; ++i) {
    const double away = std::abs(state_.x - t.position_m[static_cast<std::size_t>(i)]);
    if (place_ == i && away > t.switch_half_width_m + t.switch_hysteresis_m) place_ = 3;
    if (place_ != i && away <= t.switch_half_width_m) place_ = i;
  }
}

void HandBench::step(double h) {
  if (state_.v == 0.0) settle(0.0);
  const HandState k1 = slope(state_);
  const HandState k2 = slope(along(state_, h / 2, k1));
  const HandState k3 = slope(along(state_, h / 2, k2));
  const HandState k4 = slope(along(state_, h, k3));
  const double speed_before = state_.v;
  state_ = along(along(along(along(state_, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
  settle(speed_before);
}

}  // namespace stepwright::bench

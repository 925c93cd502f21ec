#include "plant_models/assemblies/bench_equations.h"

#include <algorithm>
#include <cmath>

namespace stepwright::assemblies {
namespace {

constexpr double kM3PerLitre = 1e-3;

// Where pump i takes liquid from. Where it delivers to: B1 to v1, B2 to the place, B3 and B4 to f1.
constexpr std::array<std::size_t, kPumps> kSource = {index(Tank::F1), index(Tank::V1), index(Tank::A1),
                                                     index(Tank::A2)};

// The tank below the vehicle's unloading hose; kTanks = nothing but the sump.
std::size_t unloading_target(Place place) {
  if (place == Place::A1) return index(Tank::A1);
  if (place == Place::A2) return index(Tank::A2);
  return kTanks;
}

}  // namespace

BenchEquations::BenchEquations(const BenchParameters& parameters)
    : pumps_(parameters.pumps),
      vehicle_(parameters.vehicle),
      track_(parameters.track),
      density_(parameters.density_kg_per_l / kM3PerLitre),
      overflow_rate_(parameters.overflow_rate_per_s) {
  for (std::size_t i = 0; i < kTanks; ++i) {
    capacity_[i] = parameters.tanks[i].capacity_l * kM3PerLitre;
    head_[i] = parameters.tanks[i].height_m / capacity_[i];
    suction_[i] = capacity_[i] * parameters.suction_percent / 100.0;
  }
}

BenchFlows BenchEquations::flows(std::span<const double> y) const {
  BenchFlows flows;
  const double* volume = &y[kVolume];
  std::array<double, kTanks> available{};  // share of a demanded outflow that the intake still gets
  for (std::size_t i = 0; i < kTanks; ++i) {
    available[i] = std::clamp(volume[i] / suction_[i], 0.0, 1.0);
    flows.leak[i] = modes.leak_m3_s[i] * available[i];
    if (i != index(Tank::F1)) flows.overflow[i] = overflow_rate_ * std::max(0.0, volume[i] - capacity_[i]);
  }
  for (std::size_t i = 0; i < kPumps; ++i) {
    std::size_t target = index(Tank::F1);
    double counter_head = 0.0;  // B3 and B4 fall freely from the return line
    if (i == index(Pump::B1)) {
      if (modes.place != Place::F1) continue;
      target = index(Tank::V1);
    }
    if (i == index(Pump::B2)) target = unloading_target(modes.place);
    if (i <= index(Pump::B2) && target < kTanks) counter_head = head_[target] * volume[target];
    const double rise = pumps_[i].lift_m + counter_head - head_[kSource[i]] * volume[kSource[i]];
    const double w = y[kPumpSpeed + i];
    const double surplus = pumps_[i].shutoff_head_m * w * w - rise;
    flows.pump[i] = std::max(0.0, surplus) / pumps_[i].resistance_m_per_m3_s * modes.pump_strength[i] *
                    available[kSource[i]];
  }
  return flows;
}

double BenchEquations::acceleration(std::span<const double> y, double loading_m3_s) const {
  const double direction = modes.direction;
  const double mass = vehicle_.empty_mass_kg + density_ * std::max(0.0, y[kVolume + index(Tank::V1)]);
  const double brake = modes.drive == 0 ? vehicle_.brake_force_n : 0.0;
  // Liquid that is loaded during motion has to be brought to the vehicle's speed.
  const double force = modes.drive * vehicle_.drive_force_n -
                       direction * (vehicle_.coulomb_friction_n + brake) -
                       (vehicle_.viscous_friction_n_per_m_s + density_ * loading_m3_s) * y[kSpeed];
  return force / mass;
}

void BenchEquations::derivative(double, std::span<const double> y, std::span<double> dydt) const {
  const BenchFlows flow = flows(y);
  const auto loading = flow.pump[index(Pump::B1)];
  const auto unloading = flow.pump[index(Pump::B2)];
  const bool moves = modes.direction != 0;
  dydt[kPosition] = moves ? y[kSpeed] : 0.0;
  dydt[kSpeed] = moves ? acceleration(y, loading) : 0.0;

  double* volume = &dydt[kVolume];
  double& sump = dydt[kSump];
  double returned = flow.pump[index(Pump::B3)] + flow.pump[index(Pump::B4)];
  sump = 0.0;
  for (std::size_t i = 0; i < kTanks; ++i) {
    volume[i] = -flow.leak[i] - flow.overflow[i];
    sump += flow.leak[i];
    returned += flow.overflow[i];
  }
  volume[index(Tank::F1)] += returned - loading;
  volume[index(Tank::V1)] += loading - unloading;
  volume[index(Tank::A1)] -= flow.pump[index(Pump::B3)];
  volume[index(Tank::A2)] -= flow.pump[index(Pump::B4)];
  const std::size_t target = unloading_target(modes.place);
  (target < kTanks ? volume[target] : sump) += unloading;

  for (std::size_t i = 0; i < kPumps; ++i) {
    const double wanted = modes.pump_on[i] ? 1.0 : 0.0;
    dydt[kPumpSpeed + i] = (wanted - y[kPumpSpeed + i]) / pumps_[i].time_constant_s;
  }
  dydt[kDrawn] = flow.pump[index(Pump::B3)];
  dydt[kDrawn + 1] = flow.pump[index(Pump::B4)];
}

void BenchEquations::roots(double, std::span<const double> y, std::span<double> g) const {
  constexpr double kNever = 1.0;
  const double x = y[kPosition];
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const bool closed = index(modes.place) == i;
    const double width = track_.switch_half_width_m + (closed ? track_.switch_hysteresis_m : 0.0);
    g[kPlaceRoot + i] = std::abs(x - track_.position_m[i]) - width;
  }
  const double direction = modes.direction;
  g[kStandstillRoot] = modes.direction != 0 ? direction * y[kSpeed] : kNever;
  g[kEndStopRoot] = modes.direction != 0 ? track_.end_stop_m - direction * x : kNever;
  for (std::size_t i = 0; i < kTanks; ++i) {
    g[kSuctionRoot + i] = (y[kVolume + i] - suction_[i]) / capacity_[i];
    if (i > 0) g[kOverflowRoot + i - 1] = (y[kVolume + i] - capacity_[i]) / capacity_[i];
  }
  for (std::size_t i = 0; i < kClients; ++i) {
    const double until = modes.draw_until_m3[i];
    g[kDrawRoot + i] = std::isfinite(until) ? y[kDrawn + i] - until : -kNever;
  }
}

double BenchEquations::percent(Tank tank, std::span<const double> y) const {
  return 100.0 * y[kVolume + index(tank)] / capacity_[index(tank)];
}

Place BenchEquations::place_at(double x) const {
  for (std::size_t i = 0; i < kPlaces; ++i) {
    if (std::abs(x - track_.position_m[i]) <= track_.switch_half_width_m) return static_cast<Place>(i);
  }
  return Place::None;
}

int BenchEquations::direction_from(double x, double speed) const {
  if (speed > 0.0) return 1;
  if (speed < 0.0) return -1;
  // At rest the brake and the static friction hold against anything but the drive.
  const bool held = modes.drive == 0 || vehicle_.drive_force_n <= vehicle_.static_friction_n;
  const bool blocked = modes.drive * x >= track_.end_stop_m;
  return held || blocked ? 0 : modes.drive;
}

}  // namespace stepwright::assemblies

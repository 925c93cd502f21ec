#include "plant_models/assemblies/tank_bench.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "plant_models/assemblies/bench_ports.h"

namespace stepwright::assemblies {
namespace {

constexpr double kNoDraw = std::numeric_limits<double>::infinity();

double seconds(std::chrono::nanoseconds time) {
  return static_cast<double>(time.count()) * 1e-9;
}

// Below these errors per step nothing that a sensor or a report shows changes: a microlitre is
// 0.00003 percent of a distributor.
ode::CvodeSettings solver_settings() {
  ode::CvodeSettings settings;
  settings.absolute_tolerance.assign(kStateSize, 1e-9);
  settings.absolute_tolerance[kPosition] = 1e-7;
  settings.absolute_tolerance[kSpeed] = 1e-7;
  for (std::size_t i = 0; i < kPumps; ++i) settings.absolute_tolerance[kPumpSpeed + i] = 1e-6;
  return settings;
}

LevelSensor make_sensor(const BenchParameters& p, std::size_t i) {
  return {p.calibration[i], p.uncertainty, p.seed, i};
}

}  // namespace

TankBench::TankBench(const BenchParameters& p)
    : equations_(p),
      description_(describe_bench(p)),
      level_sensors_{make_sensor(p, 0), make_sensor(p, 1), make_sensor(p, 2)} {
  y_[kPosition] = p.vehicle.initial_position_m;
  for (std::size_t i = 0; i < kTanks; ++i) {
    y_[kVolume + i] = equations_.capacity_m3(static_cast<Tank>(i)) * p.tanks[i].initial_percent / 100.0;
  }
  equations_.modes.place = equations_.place_at(y_[kPosition]);
}

result::Result<std::unique_ptr<TankBench>> TankBench::create(const BenchParameters& parameters) {
  if (auto valid = validate(parameters); !valid) return result::forward(valid);
  std::unique_ptr<TankBench> bench(new TankBench(parameters));
  auto solver = ode::CvodeSolver::create(bench->equations_, bench->y_, 0.0, solver_settings());
  if (!solver) return result::forward(solver);
  bench->solver_ = std::make_unique<ode::CvodeSolver>(std::move(*solver));
  return bench;
}

std::span<const core::Port> TankBench::actuators() const {
  return bench_actuators();
}
std::span<const core::Port> TankBench::sensors() const {
  return bench_sensors();
}
std::span<const core::Quantity> TankBench::truths() const {
  return bench_truths();
}
std::span<const core::Quantity> TankBench::faults() const {
  return bench_faults();
}

void TankBench::set_actuator(core::ActuatorId id, std::int16_t value) {
  assert(id.value < kActuators);
  actuators_[id.value] = value != 0;
}

// The modes that follow from actuators and draws, and the direction that follows from them.
void TankBench::update_modes() {
  BenchModes& modes = equations_.modes;
  applied_ = actuators_;
  for (std::size_t i = 0; i < kPumps; ++i) modes.pump_on[i] = actuators_[i];
  for (std::size_t i = 0; i < kClients; ++i) {
    if (std::isfinite(modes.draw_until_m3[i])) modes.pump_on[index(Pump::B3) + i] = true;
  }
  modes.drive = (actuators_[kDriveRight] ? 1 : 0) - (actuators_[kDriveLeft] ? 1 : 0);
  modes.direction = equations_.direction_from(y_[kPosition], y_[kSpeed]);
}

bool TankBench::restart(double t_s) {
  update_modes();
  return solver_->restart(t_s, y_);
}

core::PlantStatus TankBench::advance_to(std::chrono::nanoseconds time) {
  if (time <= now_ || failed_) return failed_ ? core::PlantStatus::Failed : core::PlantStatus::Good;
  if (fault_changed_ || actuators_ != applied_) {
    failed_ = !restart(seconds(now_));
    event_pending_ = false;
    fault_changed_ = false;
  }
  failed_ = failed_ || !run_to(seconds(time));
  if (failed_) return core::PlantStatus::Failed;
  now_ = time;
  return core::PlantStatus::Good;
}

bool TankBench::run_to(double t_s) {
  while (solver_->time() < t_s || (event_pending_ && solver_->time() <= t_s)) {
    if (event_pending_) {
      event_pending_ = false;
      if (!handle_event()) return false;
      continue;
    }
    const ode::StepOutcome outcome = solver_->step();
    if (outcome == ode::StepOutcome::Failed) return false;
    event_pending_ = outcome == ode::StepOutcome::Root;
  }
  return solver_->state_at(t_s, y_);
}

// Returns false if the solver cannot go on.
bool TankBench::handle_event() {
  const auto roots = solver_->roots();
  const double t_s = solver_->time();
  if (!solver_->state_at(t_s, y_)) return false;
  BenchModes& modes = equations_.modes;
  bool jumps = false;
  if (roots[kEndStopRoot] < 0) {
    y_[kPosition] = modes.direction * equations_.end_stop_m();
    y_[kSpeed] = 0.0;
    jumps = true;
  }
  if (roots[kStandstillRoot] < 0) {
    y_[kSpeed] = 0.0;
    jumps = true;
  }
  for (std::size_t i = 0; i < kPlaces; ++i) {
    if (roots[kPlaceRoot + i] != 0) jumps = change_place(i) || jumps;
  }
  for (std::size_t i = kSuctionRoot; i < kDrawRoot; ++i) jumps = jumps || roots[i] != 0;
  for (std::size_t i = 0; i < kClients; ++i) {
    if (roots[kDrawRoot + i] <= 0) continue;
    modes.draw_until_m3[i] = kNoDraw;
    jumps = true;
  }
  return !jumps || restart(t_s);
}

// Returns whether a flow jumps: a vehicle that passes a place with its pumps at rest needs no restart.
bool TankBench::change_place(std::size_t place) {
  BenchModes& modes = equations_.modes;
  const BenchFlows before = equations_.flows(y_);
  modes.place = index(modes.place) == place ? Place::None : static_cast<Place>(place);
  const BenchFlows after = equations_.flows(y_);
  const auto loading = index(Pump::B1);
  const auto unloading = index(Pump::B2);
  return before.pump[loading] != after.pump[loading] || before.pump[unloading] > 0.0 ||
         after.pump[unloading] > 0.0;
}

std::int16_t TankBench::sensor(core::SensorId id) const {
  assert(id.value < kSensors);
  if (id.value < kPlaces) {
    const SwitchFault& fault = switch_faults_[id.value];
    const bool closed = fault.active ? fault.shows : index(equations_.modes.place) == id.value;
    return closed ? 1 : 0;
  }
  const std::size_t i = id.value - kLevelSensor;
  if (frozen_[i]) return *frozen_[i];
  const DriftFault& drift = drift_faults_[i];
  const double extra = drift.counts_per_s * seconds(now_ - drift.since);
  // S1..S3 sit in v1, a1, a2, which follow f1 in the order of the tanks.
  return level_sensors_[i].counts(equations_.percent(static_cast<Tank>(i + 1), y_), now_, extra);
}

void TankBench::keep(std::span<double> numbers) const {
  numbers[0] = y_[kPosition];
  for (std::size_t i = 0; i < kTanks; ++i) numbers[i + 1] = equations_.percent(static_cast<Tank>(i), y_);
}

double TankBench::truth(core::TruthId id) const {
  constexpr double kLitres = 1e3;
  const TruthTarget target = bench_truth_target(id.value);
  const std::size_t i = target.index;
  switch (target.kind) {
    case TruthKind::LevelPercent:
      return equations_.percent(static_cast<Tank>(i), y_);
    case TruthKind::Position:
      return y_[kPosition];
    case TruthKind::Speed:
      return y_[kSpeed];
    case TruthKind::TotalLiquid:
      return kLitres * std::accumulate(&y_[kVolume], &y_[kSump] + 1, 0.0);
    case TruthKind::Sump:
      return kLitres * y_[kSump];
    case TruthKind::DeliveredPercent:
      return 100.0 * y_[kDrawn + i] / equations_.capacity_m3(client_tank(i));
    case TruthKind::PumpSpeed:
      return y_[kPumpSpeed + i];
    case TruthKind::PumpFlow:
      return kLitres * equations_.flows(y_).pump[i];
    case TruthKind::OverflowFlow:
      return kLitres * equations_.flows(y_).overflow[i];
    case TruthKind::LeakFlow: {
      const BenchFlows flows = equations_.flows(y_);
      return kLitres * std::accumulate(flows.leak.begin(), flows.leak.end(), 0.0);
    }
  }
  return 0.0;
}

}  // namespace stepwright::assemblies

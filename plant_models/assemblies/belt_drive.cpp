#include "plant_models/assemblies/belt_drive.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stepwright::assemblies {
namespace {

constexpr std::size_t kSpeed = 0;
constexpr std::size_t kCurrent = 1;
constexpr double kLoadStepN = 1.0;  // smaller changes of the load restart nothing

ode::CvodeSettings solver_settings() {
  ode::CvodeSettings settings;
  settings.relative_tolerance = 1e-5;
  settings.absolute_tolerance = {1e-6, 1e-4};
  return settings;
}

}  // namespace

class BeltDrive::Equations final : public ode::OdeSystem {
 public:
  explicit Equations(const BeltDriveParameters& parameters) : p(parameters) {}

  const BeltDriveParameters p;
  bool on = false;
  double load_n = 0.0;

  std::size_t state_size() const override { return 2; }
  std::size_t root_count() const override { return 1; }

  void derivative(double, std::span<const double> y, std::span<double> dydt) const override {
    const double wanted =
        on ? std::clamp(p.gain_a_per_m_s * (p.nominal_speed_m_s - y[kSpeed]), 0.0, p.current_limit_a) : 0.0;
    dydt[kCurrent] = (wanted - y[kCurrent]) / p.current_time_s;
    const double force = p.force_n_per_a * y[kCurrent] - p.friction_n - load_n - (on ? 0.0 : p.brake_n);
    dydt[kSpeed] = force / p.moved_mass_kg;
    // Friction holds what stands until the motor is stronger.
    if (y[kSpeed] <= 0.0 && force < 0.0) dydt[kSpeed] = 0.0;
  }

  void roots(double, std::span<const double> y, std::span<double> g) const override { g[0] = y[kSpeed]; }
};

BeltDrive::BeltDrive(const BeltDriveParameters& parameters)
    : equations_(std::make_unique<Equations>(parameters)) {}
BeltDrive::~BeltDrive() = default;
BeltDrive::BeltDrive(BeltDrive&&) noexcept = default;
BeltDrive& BeltDrive::operator=(BeltDrive&&) noexcept = default;

result::Result<BeltDrive> BeltDrive::create(const BeltDriveParameters& parameters) {
  BeltDrive drive(parameters);
  auto solver = ode::CvodeSolver::create(*drive.equations_, drive.state_, 0.0, solver_settings());
  if (!solver) return result::forward(solver);
  drive.solver_ = std::make_unique<ode::CvodeSolver>(std::move(*solver));
  return drive;
}

void BeltDrive::command(bool on) {
  if (equations_->on == on) return;
  equations_->on = on;
  changed_ = true;
}

void BeltDrive::load(double force_n) {
  if (std::abs(force_n - load_n_) < kLoadStepN) return;
  load_n_ = force_n;
  changed_ = true;
}

void BeltDrive::restore(double speed_m_s, double current_a) {
  state_ = {speed_m_s, current_a};
  changed_ = true;
}

// Nothing drives it, so nothing has to be integrated.
bool BeltDrive::stands() const {
  return !equations_->on && state_[kSpeed] == 0.0;
}

bool BeltDrive::come_to_rest() {
  at_root_ = false;
  if (!solver_->state_at(solver_->time(), state_)) return false;
  if (solver_->roots()[0] < 0) state_[kSpeed] = 0.0;
  return solver_->restart(solver_->time(), state_);
}

bool BeltDrive::advance_to(double t_s) {
  if (stands()) {
    state_[kCurrent] = 0.0;
    equations_->load_n = load_n_;
    time_s_ = t_s;
    changed_ = true;
    return true;
  }
  if (changed_) {
    equations_->load_n = load_n_;
    if (!solver_->restart(time_s_, state_)) return false;
    changed_ = at_root_ = false;
  }
  while (solver_->time() < t_s) {
    if (at_root_ && !come_to_rest()) return false;
    if (stands()) break;
    const ode::StepOutcome outcome = solver_->step();
    if (outcome == ode::StepOutcome::Failed) return false;
    at_root_ = outcome == ode::StepOutcome::Root;
  }
  time_s_ = t_s;
  if (stands()) return true;
  if (!solver_->state_at(t_s, state_)) return false;
  state_[kSpeed] = std::max(state_[kSpeed], 0.0);
  return true;
}

}  // namespace stepwright::assemblies

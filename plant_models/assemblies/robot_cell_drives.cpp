#include "plant_models/assemblies/robot_cell_drives.h"

#include <algorithm>
#include <cmath>

namespace stepwright::assemblies {
namespace {

constexpr double kBraking = 0.8;  // share of the acceleration that the position loop counts on
constexpr double kSpeedError_rad_s = 2e-5;
constexpr double kFirstStep_s = 1e-3;
constexpr double kBrakeSettle_rad_s = 0.02;  // dry friction, smooth near standstill
constexpr double kLoadStep_rad_s2 = 1e-3;    // smaller changes of a load restart nothing

// Set points change in every scan, and with them the solver starts anew. An error of a speed counts by what
// it makes of the angle within such a time.
ode::CvodeSettings drive_settings(std::size_t joints, std::size_t hands) {
  ode::CvodeSettings settings;
  settings.absolute_tolerance.assign(2 * joints + hands, 1e-7);
  std::fill_n(settings.absolute_tolerance.begin() + static_cast<std::ptrdiff_t>(joints), joints,
              kSpeedError_rad_s);
  settings.first_step_s = kFirstStep_s;
  return settings;
}

}  // namespace

RobotDrives::Equations::Equations(const RobotCellParameters& parameters)
    : drive(parameters.drive), hand(parameters.hand) {
  for (const ArmFigures& arm : parameters.arms) {
    figures.insert(figures.end(), arm.joints.begin(), arm.joints.end());
    for (const double start_rad : arm.start_rad) joints.push_back({.wanted_rad = start_rad});
    hands.push_back({.wanted_m = arm.most_opening_m});
    most_opening_m.push_back(arm.most_opening_m);
  }
}

// Linear near the set point; farther away the speed from which it can still be braked. Both meet smoothly.
double RobotDrives::Equations::wanted_speed(std::size_t joint, double angle_rad) const {
  const JointMode& mode = joints[joint];
  if (mode.runaway_rad_s != 0.0) return mode.runaway_rad_s;
  const double away = mode.wanted_rad - angle_rad;
  const double gain = drive.position_gain_1_s;
  const double braking = kBraking * drive.acceleration_rad_s2[joint % kArmJoints];
  const double linear_rad = braking / (gain * gain);
  const double size = std::abs(away);
  const double speed =
      size <= linear_rad ? gain * size : std::sqrt(2.0 * braking * (size - 0.5 * linear_rad));
  return std::copysign(std::min(speed, figures[joint].velocity_rad_s), away);
}

void RobotDrives::Equations::derivative(double, std::span<const double> y, std::span<double> dydt) const {
  const std::size_t n = joints.size();
  for (std::size_t k = 0; k < n; ++k) {
    const JointMode& mode = joints[k];
    const double speed = y[n + k];
    dydt[k] = mode.stuck ? 0.0 : speed;
    if (mode.stuck) {
      dydt[n + k] = -speed / drive.time_constant_s;
    } else if (mode.braked) {
      dydt[n + k] = -drive.brake_rad_s2 * std::clamp(speed / kBrakeSettle_rad_s, -1.0, 1.0);
    } else {
      const double most = drive.acceleration_rad_s2[k % kArmJoints];
      const double driven = (wanted_speed(k, y[k]) - speed) / drive.time_constant_s;
      dydt[n + k] = std::clamp(driven, -most, most) + mode.load_rad_s2;
    }
  }
  for (std::size_t k = 0; k < hands.size(); ++k) {
    const double opening = y[2 * n + k];
    const double wanted = std::clamp(hands[k].wanted_m, hands[k].least_m, most_opening_m[k]);
    const double speed = std::clamp(hand.gain_1_s * (wanted - opening), -hand.speed_m_s, hand.speed_m_s);
    dydt[2 * n + k] = hands[k].dead ? 0.0 : speed;
  }
}

RobotDrives::RobotDrives(const RobotCellParameters& parameters) : equations_(parameters) {
  y_.assign(equations_.state_size(), 0.0);
  for (std::size_t k = 0; k < joints(); ++k) y_[k] = equations_.joints[k].wanted_rad;
  for (std::size_t k = 0; k < hands(); ++k) y_[2 * joints() + k] = equations_.most_opening_m[k];
}

result::Result<std::unique_ptr<RobotDrives>> RobotDrives::create(const RobotCellParameters& parameters) {
  if (auto valid = validate(parameters); !valid) return result::forward(valid);
  std::unique_ptr<RobotDrives> drives(new RobotDrives(parameters));
  auto motion = SwitchedMotion::create(drives->equations_, drives->y_,
                                       drive_settings(drives->joints(), drives->hands()));
  if (!motion) return result::forward(motion);
  drives->motion_ = std::move(*motion);
  return drives;
}

void RobotDrives::set(std::size_t joint, JointMode mode) {
  const JointMode& now = equations_.joints[joint];
  const JointFigures& figures = equations_.figures[joint];
  mode.wanted_rad = std::clamp(mode.wanted_rad, figures.lower_rad, figures.upper_rad);
  if (std::abs(mode.load_rad_s2 - now.load_rad_s2) < kLoadStep_rad_s2) mode.load_rad_s2 = now.load_rad_s2;
  if (mode == now) return;
  equations_.joints[joint] = mode;
  motion_->note_change();
}

void RobotDrives::set_hand(std::size_t hand, const HandMode& mode) {
  if (mode == equations_.hands[hand]) return;
  equations_.hands[hand] = mode;
  motion_->note_change();
}

void RobotDrives::stop_hand_at(std::size_t hand, double opening_m) {
  y_[2 * joints() + hand] = opening_m;
  equations_.hands[hand].least_m = opening_m;
  motion_->note_change();
}

void RobotDrives::place(std::size_t joint, double angle_rad) {
  y_[joint] = angle_rad;
  y_[joints() + joint] = 0.0;
  motion_->note_change();
}

bool RobotDrives::advance_to(double t_s) {
  if (!motion_->advance_to(t_s, y_)) return false;
  for (std::size_t k = 0; k < joints(); ++k) {
    const JointFigures& figures = equations_.figures[k];
    const double within = std::clamp(y_[k], figures.lower_rad, figures.upper_rad);
    if (within != y_[k]) place(k, within);  // its end stop
  }
  return true;
}

}  // namespace stepwright::assemblies

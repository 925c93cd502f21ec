#pragma once

// One forklift in motion: its equations under CVODE, moved by commands.
//
// Thread rule: one thread at a time. command() and advance_to() allocate nothing. The state depends on the
// instants of changed commands only, bit for bit, however finely advance_to() slices the time.
//
//   auto forklift = Forklift::create({}, {.x_m = 2.0, .y_m = 3.0});
//   (*forklift)->command({.enabled = true, .speed_m_s = 1.0, .lock_rad = 0.1});
//   if (!(*forklift)->advance_to(0.01)) ...

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "plant_models/assemblies/forklift_equations.h"
#include "plant_models/assemblies/switched_motion.h"

namespace stepwright::assemblies {

struct ForkliftPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;

  friend bool operator==(const ForkliftPose&, const ForkliftPose&) = default;
};

struct ForkliftCommand {
  bool enabled = false;
  double speed_m_s = 0.0;
  double lock_rad = 0.0;

  friend bool operator==(const ForkliftCommand&, const ForkliftCommand&) = default;
};

class Forklift {
 public:
  // Stands still at `start`, with its wheel straight. Fails with the C0321 of validate() or with C0331
  // (solver).
  [[nodiscard]] static result::Result<std::unique_ptr<Forklift>> create(const ForkliftParameters& parameters,
                                                                        const ForkliftPose& start);

  // From now on. Numbers that are not finite switch the drive off.
  void command(const ForkliftCommand& command);
  // A changed mode: load, weakness, slip. Commands in it are overwritten by the next command().
  void set_modes(const ForkliftModes& modes);
  const ForkliftModes& modes() const { return equations_.modes; }

  // Runs to `t_s`; a time that has passed changes nothing. False if the solver has given up, for good.
  bool advance_to(double t_s) { return motion_->advance_to(t_s, y_); }

  ForkliftPose pose() const { return {y_[kForkliftX], y_[kForkliftY], y_[kForkliftHeading]}; }
  double speed_m_s() const { return equations_.ground_speed_m_s(y_); }
  double curvature_1_m() const { return equations_.curvature_1_m(y_); }
  std::span<const double> state() const { return y_; }
  // Puts it at another place, at rest there: what a collision or a pallet does to it.
  void stop_at(const ForkliftPose& pose);

 private:
  explicit Forklift(const ForkliftParameters& parameters, const ForkliftPose& start);
  Forklift(const Forklift&) = delete;
  Forklift& operator=(const Forklift&) = delete;

  ForkliftEquations equations_;  // the solver points to it
  std::array<double, kForkliftStates> y_{};
  std::optional<SwitchedMotion> motion_;
};

}  // namespace stepwright::assemblies

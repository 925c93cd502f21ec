#pragma once

// A tugger train in motion: its equations under CVODE, moved by commands, and where its links are.
//
// Thread rule: one thread at a time. Nothing is allocated after create(). The state depends on the instants
// of changed commands only, bit for bit, however finely advance_to() slices the time.
//
//   auto train = TuggerTrain::create({.trailers = 3});
//   (*train)->command(true, 1.0, 0.1);
//   if (!(*train)->advance_to(0.01)) ...
//   const PlacedBox last = (*train)->boxes().back();

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "plant_models/assemblies/floor_polygon.h"
#include "plant_models/assemblies/switched_motion.h"
#include "plant_models/assemblies/tugger_equations.h"

namespace stepwright::assemblies {

class TuggerTrain {
 public:
  // Stands still at the parameters' start, its wheel straight and all links in one line. Fails with the C0321
  // of validate() or with C0331 (solver).
  [[nodiscard]] static result::Result<std::unique_ptr<TuggerTrain>> create(
      const TuggerParameters& parameters);

  // From now on; the speed of the wheels' rim, and the steering. Numbers that are not finite switch the drive
  // off.
  void command(bool enabled, double speed_m_s, double lock_rad);
  // A changed mode: weakness, slip. Commands in it are overwritten by the next command(), its load is the
  // trailers'.
  void set_modes(const BicycleModes& modes);
  const BicycleModes& modes() const { return equations_.modes; }

  // Runs to `t_s`; a time that has passed changes nothing. False if the solver has given up, for good.
  bool advance_to(double t_s);

  std::size_t coupled() const { return equations_.coupled; }
  // The first `trailers` of those that the parameters allow; those that were not coupled get behind the
  // others, in line with the last of them.
  void couple(std::size_t trailers);

  std::span<const double> state() const { return {y_.data(), states_}; }
  double speed_m_s() const { return equations_.ground_speed_m_s(y_); }
  double curvature_1_m() const { return equations_.curvature_1_m(y_); }
  body2d::Pose tractor() const { return {{y_[kBicycleX], y_[kBicycleY]}, y_[kBicycleHeading]}; }
  // Heading of the tractor (0) or the trailer `link`, rad, not wrapped.
  double heading_rad(std::size_t link) const {
    return link == 0 ? y_[kBicycleHeading] : y_[kTuggerTrailer + link - 1];
  }
  // How far the link in front of a coupled trailer (1, ...) is turned to the left of it, within +-pi.
  double hitch_rad(std::size_t trailer) const;
  // The tractor and the trailers that are coupled.
  std::span<const PlacedBox> boxes() const { return {boxes_.data(), 1 + coupled()}; }

  // Where another state of this train was, at rest there: what a collision does to it.
  void stop_at(std::span<const double> state);

 private:
  explicit TuggerTrain(const TuggerParameters& parameters);
  TuggerTrain(const TuggerTrain&) = delete;
  TuggerTrain& operator=(const TuggerTrain&) = delete;
  void place_boxes();

  TuggerLinks links_;
  double trailer_kg_;
  TuggerEquations equations_;  // the solver points to it
  std::size_t states_;
  std::array<double, kMostTuggerStates> y_{};
  std::array<PlacedBox, kMostTuggerTrailers + 1> boxes_;
  std::optional<SwitchedMotion> motion_;
};

}  // namespace stepwright::assemblies

#pragma once

// The motor of a belt: a current loop with a limit, the mass that it moves, dry friction, a brake.
//
//   di/dt = (i_ref - i) / tau,   i_ref = clamp(K (v_ref - v), 0, i_max) while on, 0 while off
//   m dv/dt = F i - F_c - F_l - [off] F_b        while the belt moves; it never runs backwards
//
// F_l is what boxes drag at the belt. CVODE integrates between changes; it restarts when the command changes,
// when the load has changed by more than a newton, and when the belt comes to rest.
//
// Thread rule: one thread at a time; no heap after create().
//
//   auto drive = BeltDrive::create({});
//   drive->command(true);
//   drive->advance_to(0.5);
//   double speed = drive->speed_m_s();

#include <array>
#include <memory>
#include <span>

#include "plant_models/ode/cvode_solver.h"
#include "plant_models/ode/ode_system.h"
#include "runtime/ground/result/result.h"

namespace stepwright::assemblies {

struct BeltDriveParameters {
  double nominal_speed_m_s = 0.5;  // v_ref
  double moved_mass_kg = 20.0;     // belt, rollers and rotor, as if on the belt
  double force_n_per_a = 10.0;     // F
  double current_limit_a = 8.0;    // i_max
  double current_time_s = 0.02;    // tau
  double gain_a_per_m_s = 200.0;   // K
  double friction_n = 10.0;        // F_c
  double brake_n = 70.0;           // F_b
};

class BeltDrive {
 public:
  // Fails with C0331 (solver).
  [[nodiscard]] static result::Result<BeltDrive> create(const BeltDriveParameters& parameters);
  ~BeltDrive();
  BeltDrive(BeltDrive&&) noexcept;
  BeltDrive& operator=(BeltDrive&&) noexcept;

  void command(bool on);
  // Drag of the boxes against the motion, N; takes effect at the next advance.
  void load(double force_n);
  // Runs to `t_s`, which must not lie before what it was told last. False if the solver gave up.
  bool advance_to(double t_s);

  double speed_m_s() const { return state_[0]; }
  double current_a() const { return state_[1]; }
  ode::CvodeStatistics statistics() const { return solver_->statistics(); }
  // Goes on from another state, at the present time.
  void restore(double speed_m_s, double current_a);

 private:
  class Equations;
  explicit BeltDrive(const BeltDriveParameters& parameters);
  bool stands() const;
  bool come_to_rest();

  std::unique_ptr<Equations> equations_;  // does not move
  std::unique_ptr<ode::CvodeSolver> solver_;
  std::array<double, 2> state_{};  // speed, current at time_
  double time_s_ = 0.0;
  bool changed_ = false;
  bool at_root_ = false;
  double load_n_ = 0.0;
};

}  // namespace stepwright::assemblies

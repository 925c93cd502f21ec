#pragma once

// The joint drives and hands of a robot cell under CVODE: each joint is a cascade of position and speed loops
// with limited speed and acceleration, each hand a first-order opening. plant_models/doc/robot_cell.md has
// the equations.
//
// Thread rule: one thread at a time. Nothing is allocated after create(). Invariants: no joint is beyond its
// limits after an advance_to(); a joint's speed stays within its limit, to 1e-4 rad/s.
//
//   auto drives = RobotDrives::create(parameters);
//   (*drives)->change(0, [](JointMode& joint) { joint.wanted_rad = 0.5; });
//   if (!(*drives)->advance_to(0.005)) ...
//   const double angle_rad = (*drives)->angle_rad(0);

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "plant_models/assemblies/robot_cell_parameters.h"
#include "plant_models/assemblies/switched_motion.h"
#include "plant_models/ode/ode_system.h"

namespace stepwright::assemblies {

// How a joint is driven now.
struct JointMode {
  double wanted_rad = 0.0;  // kept within the joint's limits
  bool braked = true;
  bool stuck = false;
  double runaway_rad_s = 0.0;  // the speed of one that has lost its position; 0: it has not
  double load_rad_s2 = 0.0;    // what the weight of a held object does

  friend bool operator==(const JointMode&, const JointMode&) = default;
};

struct HandMode {
  double wanted_m = 0.0;
  double least_m = 0.0;  // it does not close further: something is between the fingers
  bool dead = false;

  friend bool operator==(const HandMode&, const HandMode&) = default;
};

class RobotDrives {
 public:
  // Fails with the diagnostics of validate(), or with C0331.
  [[nodiscard]] static result::Result<std::unique_ptr<RobotDrives>> create(
      const RobotCellParameters& parameters);

  // Joints are numbered arm by arm: arm * 7 + joint.
  std::size_t joints() const { return equations_.joints.size(); }
  std::size_t hands() const { return equations_.hands.size(); }
  double angle_rad(std::size_t joint) const { return y_[joint]; }
  double speed_rad_s(std::size_t joint) const { return y_[joints() + joint]; }
  double opening_m(std::size_t hand) const { return y_[2 * joints() + hand]; }
  std::span<const double> state() const { return y_; }
  const JointMode& joint(std::size_t joint) const { return equations_.joints[joint]; }
  const HandMode& hand(std::size_t hand) const { return equations_.hands[hand]; }

  void set(std::size_t joint, JointMode mode);
  void set_hand(std::size_t hand, const HandMode& mode);
  // Of the joint, in its new mode; the others keep theirs.
  template <typename Change>
  void change(std::size_t joint, Change work) {
    JointMode mode = equations_.joints[joint];
    work(mode);
    set(joint, mode);
  }
  // Closed so far by what is between the fingers.
  void stop_hand_at(std::size_t hand, double opening_m);
  // Elsewhere, at rest.
  void place(std::size_t joint, double angle_rad);

  // False if the solver has given up, for good.
  bool advance_to(double t_s);

 private:
  struct Equations final : ode::OdeSystem {
    explicit Equations(const RobotCellParameters& parameters);
    std::size_t state_size() const override { return 2 * joints.size() + hands.size(); }
    std::size_t root_count() const override { return 0; }
    void derivative(double t, std::span<const double> y, std::span<double> dydt) const override;
    void roots(double, std::span<const double>, std::span<double>) const override {}
    double wanted_speed(std::size_t joint, double angle_rad) const;

    std::vector<JointFigures> figures;
    DriveFigures drive;
    HandFigures hand;
    std::vector<double> most_opening_m;
    std::vector<JointMode> joints;
    std::vector<HandMode> hands;
  };

  explicit RobotDrives(const RobotCellParameters& parameters);

  Equations equations_;
  std::vector<double> y_;
  std::optional<SwitchedMotion> motion_;
};

}  // namespace stepwright::assemblies

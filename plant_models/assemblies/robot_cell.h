#pragma once

// A robot cell as a plant: CVODE moves the joints of one or two arms (robot_cell_drives.h), hands hold
// objects by friction (robot_cell_grasp.h), a camera reports what it sees (robot_cell_camera.h), and a judge
// says who touched whom and what fell (robot_cell_judge.h). Thread rule and terminal semantics: core::Plant.
// plant_models/doc/robot_cell.md has the model.
//
// Reproducible: everything advances by fixed steps of 5 ms of plant time, whatever advance_to() is asked;
// what is commanded takes effect with the next step. Same parameters and the same calls at the same instants:
// the same bits, on machines with the same libraries. Invariant: an arm that has run into an arm or into
// something fixed stays where the step began, braked, until its enable is taken away.
//
//   auto cell = RobotCell::create(parameters);
//   if (!cell) return forward(cell);
//   (*cell)->set_actuator(*core::find_actuator(**cell, "enable_left"), 1);
//   (*cell)->set_actuator(*core::find_actuator(**cell, "set_left_1"), 5'000);     // 0.5 rad
//   (*cell)->advance(std::chrono::milliseconds(10));

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "plant_models/assemblies/robot_cell_camera.h"
#include "plant_models/assemblies/robot_cell_drives.h"
#include "plant_models/assemblies/robot_cell_grasp.h"
#include "plant_models/assemblies/robot_cell_judge.h"
#include "plant_models/assemblies/robot_cell_objects.h"
#include "plant_models/assemblies/robot_cell_ports.h"
#include "plant_models/core/plant.h"

namespace stepwright::assemblies {

inline constexpr std::chrono::nanoseconds kRobotCellStep{5'000'000};
inline constexpr double kRobotCellStepS = 0.005;

class RobotCell final : public core::Plant {
 public:
  // Fails with the diagnostics of validate(), or with C0331 (solver).
  [[nodiscard]] static result::Result<std::unique_ptr<RobotCell>> create(
      const RobotCellParameters& parameters);

  std::span<const core::Port> actuators() const override { return ports_.actuators; }
  std::span<const core::Port> sensors() const override { return ports_.sensors; }
  std::span<const core::Quantity> truths() const override { return ports_.truths; }
  std::span<const core::Quantity> faults() const override { return ports_.faults; }
  core::FaultRange fault_range(std::size_t fault) const override { return ports_.fault_ranges[fault]; }
  std::string violation() const override;
  const core::PlantDescription& description() const override { return description_; }

  std::chrono::nanoseconds now() const override { return now_; }
  void set_actuator(core::ActuatorId id, std::int16_t value) override;
  core::PlantStatus advance_to(std::chrono::nanoseconds time) override;
  std::int16_t sensor(core::SensorId id) const override;
  double truth(core::TruthId id) const override;
  [[nodiscard]] result::Result<void> inject_fault(std::string_view name, double value) override;
  [[nodiscard]] result::Result<void> clear_fault(std::string_view name) override;

  // Angles and openings, what each hand holds and how, where each object is and on what.
  std::size_t kept_size() const override;
  void keep(std::span<double> numbers) const override;
  // Goes on from what a cell of the same parameters kept, at rest. False, and nothing happens, if none can
  // have kept it.
  bool resume(std::span<const double> numbers);

  const RobotCellJudge& judge() const { return judge_; }
  const CellObjects& objects() const { return objects_; }
  const RobotDrives& drives() const { return *drives_; }
  std::uint64_t state_hash() const;

 private:
  struct Arm {
    // As commanded.
    bool enable = false;
    std::array<std::int16_t, kArmJoints> wanted{};
    std::int16_t opening = 0;
    // How it is.
    bool tripped = false;
    std::array<ArmPose, 3> poses{};  // now, and the steps before
    double opening_before_m = 0.0;
    std::optional<Grasp> grasp;
    bool slip_noted = false;
    // Faults.
    double friction_lost = 0.0;
    bool drops = false;
    bool dead_hand = false;
  };
  struct JointFault {
    bool stuck = false;
    bool overcurrent = false;
    double runaway_rad_s = 0.0;
  };

  explicit RobotCell(const RobotCellParameters& parameters);

  bool step();
  void command(std::size_t arm);
  void command_hand(std::size_t arm);
  double load_rad_s2(std::size_t arm, std::size_t joint) const;
  void watch_drives(std::size_t arm);
  void pose_arm(std::size_t arm);
  // Hands.
  void seek(std::size_t arm);
  void take(std::size_t arm, std::size_t object, const Fit& fit);
  void hold_on(std::size_t arm);
  void carry(std::size_t arm);
  void follow_other(std::size_t arm);
  void release(std::size_t arm);
  bool other_holds(std::size_t arm, std::size_t object) const;
  double grip_force_n(std::size_t arm) const;
  Vec3 acceleration_of(std::size_t arm) const;
  // What was kept.
  bool can_be_arm(std::size_t arm, std::span<const double> kept) const;
  bool restore_objects(std::span<const double> numbers, const std::vector<bool>& in_a_hand);
  void restore_arm(std::size_t arm, std::span<const double> kept);
  // What is touched.
  bool has_moved() const;
  void look();
  void put_blockages();
  void stop_where_it_was(std::size_t arm);
  void push(const Touch& touch);

  std::int16_t counts_of(CellSensor kind, std::size_t index) const;
  std::int16_t seen(CellSensor kind, std::size_t slot) const;
  double truth_of_object(CellTruth kind, std::size_t object) const;
  void apply_fault(CellFault kind, std::size_t index, double value, bool active);
  void shift(std::size_t object, Vec3 by);
  double end_s() const { return static_cast<double>(steps_ + 1) * kRobotCellStepS; }

  RobotCellParameters parameters_;
  RobotCellPorts ports_;
  core::PlantDescription description_;
  std::unique_ptr<RobotDrives> drives_;
  CellObjects objects_;
  CellCamera camera_;
  RobotCellJudge judge_;
  std::vector<Arm> arms_;
  std::vector<JointFault> joint_faults_;
  std::vector<double> before_;  // state of the drives when the step began
  std::vector<double> looked_;  // and at the last look of the judge
  std::array<bool, kMostCellBlockages> blocked_{};
  std::array<bool, kMostCellBlockages> to_block_{};  // that shall stand, and something may be in their place
  bool emergency_stop_ = false;
  bool triggered_ = false;
  bool changed_ = true;  // something but the arms, since the last look
  double worst_tilt_rad_ = 0.0;
  std::int64_t steps_ = 0;
  std::chrono::nanoseconds now_{0};
  bool failed_ = false;
};

}  // namespace stepwright::assemblies

#pragma once

// A robot cell for tests: arms whose elbow and wrist move in a plane, with inverse kinematics by the law of
// cosines, over a table whose top is at 0.70 m. Terminals and truths by name.
//
//   Rig rig(cell({{"cup", ObjectKind::Cup, 0.5, 0.0}}));
//   rig.go({0.5, 0.75}, 1.0);       // tool point of the first arm, in its plane

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "plant_models/assemblies/robot_cell.h"

namespace stepwright::assemblies::robot_rig {

inline constexpr double kLimb_m = 0.4;
inline constexpr double kTool_m = 0.15;
inline constexpr double kShoulder_m = 1.0;
inline constexpr double kTop_m = 0.70;

struct InPlane {
  double x_m = 0.5;
  double z_m = 0.9;
};

// Joints 2, 4 and 6 so that the tool is there and looks down; the others are 0.
inline std::array<double, kArmJoints> angles_of(InPlane tool) {
  const double x = tool.x_m;
  const double z = tool.z_m + kTool_m - kShoulder_m;
  const double elbow = std::acos((x * x + z * z) / (2.0 * kLimb_m * kLimb_m) - 1.0);
  const double shoulder = std::atan2(x, z) - 0.5 * elbow;
  return {0.0, shoulder, 0.0, elbow, 0.0, std::numbers::pi - shoulder - elbow, 0.0};
}

// Its plane is y = `y_m`, or turned about the vertical by joint 1.
inline ArmFigures arm(const std::string& name, double y_m, InPlane start = {}) {
  ArmFigures figures;
  figures.name = name;
  constexpr std::array<Vec3, kArmJoints> kAxes = {
      {{0, 0, 1}, {0, 1, 0}, {0, 0, 1}, {0, 1, 0}, {0, 0, 1}, {0, 1, 0}, {0, 0, 1}}};
  for (std::size_t k = 0; k < kArmJoints; ++k)
    figures.joints[k] = {{{}, {0, 0, k == 3 || k == 5 ? kLimb_m : 0.0}}, kAxes[k], -3.2, 3.2, 2.0};
  figures.joints[0].before.place = {0.0, y_m, kShoulder_m};
  figures.tool.place = {0.0, 0.0, kTool_m};
  figures.bodies = {{1, cylinder_solid(0.05, 0.3), {{}, {0, 0, 0.2}}, {}},
                    {3, cylinder_solid(0.05, 0.3), {{}, {0, 0, 0.2}}, {}},
                    {6, box_solid({0.06, 0.16, 0.06}), {{}, {0, 0, 0.06}}, {}},
                    {6, box_solid({0.022, 0.012, 0.08}), {{}, {0, 0.006, 0.13}}, {0, 1, 0}},
                    {6, box_solid({0.022, 0.012, 0.08}), {{}, {0, -0.006, 0.13}}, {0, -1, 0}}};
  figures.start_rad = angles_of(start);
  return figures;
}

inline RobotCellParameters cell(std::vector<ObjectFigures> objects, std::size_t arms = 1) {
  RobotCellParameters parameters;
  parameters.arms.push_back(arm("left", 0.0));
  if (arms == 2) parameters.arms.push_back(arm("right", -0.6));
  parameters.fixed = {{"table", box_solid({0.6, 2.0, 0.05}), {{}, {0.6, 0.0, kTop_m - 0.025}}, true, false}};
  parameters.objects = std::move(objects);
  return parameters;
}

class Rig {
 public:
  explicit Rig(const RobotCellParameters& parameters) : plant_(RobotCell::create(parameters).value()) {
    for (const ArmFigures& each : parameters.arms) {
      names_.push_back(each.name);
      at_.push_back({});
      set("enable_" + each.name, 1);
    }
  }

  RobotCell* operator->() { return plant_.get(); }
  RobotCell& plant() { return *plant_; }
  void set(const std::string& name, int value) {
    plant_->set_actuator(*core::find_actuator(*plant_, name), static_cast<std::int16_t>(value));
  }
  void run(double seconds) {
    const auto steps = static_cast<int>(std::lround(seconds / 0.01));
    for (int k = 0; k < steps; ++k)
      ASSERT_EQ(plant_->advance(std::chrono::milliseconds(10)), core::PlantStatus::Good);
  }
  void point(std::size_t arm, InPlane tool, double turn_rad = 0.0) {
    auto angles = angles_of(tool);
    angles[0] = turn_rad;
    for (std::size_t k = 0; k < kArmJoints; ++k)
      set("set_" + names_[arm] + "_" + std::to_string(k + 1), static_cast<int>(std::lround(1e4 * angles[k])));
  }
  // Along a line, with a smooth course of the speed.
  void go(InPlane to, double seconds, std::size_t arm = 0) {
    const InPlane from = at_[arm];
    const auto steps = static_cast<int>(std::lround(seconds / 0.01));
    for (int k = 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const double s = t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
      point(arm, {from.x_m + s * (to.x_m - from.x_m), from.z_m + s * (to.z_m - from.z_m)});
      run(0.01);
    }
    at_[arm] = to;
  }
  void grip(double opening_m, std::size_t arm = 0) {
    set("grip_" + names_[arm], static_cast<int>(std::lround(1e4 * opening_m)));
    run(0.6);
  }
  int sensor(const std::string& name) { return plant_->sensor(*core::find_sensor(*plant_, name)); }
  double truth(const std::string& name) { return plant_->truth(*core::find_truth(*plant_, name)); }
  void fault(const std::string& name, double value) {
    const auto injected = plant_->inject_fault(name, value);
    ASSERT_TRUE(injected) << result::to_string(injected.error());
  }
  double contacts() {
    return truth("contacts_arm_arm") + truth("contacts_arm_fixed") + truth("contacts_arm_object") +
           truth("contacts_object_object") + truth("contacts_object_fixed");
  }
  std::string incidents() {
    std::string text;
    for (const Incident& each : plant_->judge().incidents()) text += plant_->judge().text(each) + "\n";
    return text;
  }
  std::vector<double> kept() {
    std::vector<double> numbers(plant_->kept_size());
    plant_->keep(numbers);
    return numbers;
  }

 private:
  std::unique_ptr<RobotCell> plant_;
  std::vector<std::string> names_;
  std::vector<InPlane> at_;
};

}  // namespace stepwright::assemblies::robot_rig

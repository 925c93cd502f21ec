#include <string>

#include "plant_models/assemblies/robot_cell.h"

namespace stepwright::assemblies {
namespace {

constexpr std::string_view kRobotCellPlant = "the robot cell";
constexpr double kMPerMm = 1e-3;

}  // namespace

// Things that fall or are moved may touch others; arms touch neither each other nor what is fixed.
std::string RobotCell::violation() const {
  for (const Incident& incident : judge().incidents())
    if (incident.kind == IncidentKind::ArmArm || incident.kind == IncidentKind::ArmFixed)
      return judge().text(incident);
  return {};
}

result::Result<void> RobotCell::inject_fault(std::string_view name, double value) {
  auto fault = find_fault(kRobotCellPlant, ports_.faults, name);
  if (!fault) return result::forward(fault);
  if (auto good = check_fault(ports_.faults[*fault], ports_.fault_ranges[*fault], value); !good) return good;
  apply_fault(ports_.fault_targets[*fault].kind, ports_.fault_targets[*fault].index, value, true);
  return {};
}

result::Result<void> RobotCell::clear_fault(std::string_view name) {
  auto fault = find_fault(kRobotCellPlant, ports_.faults, name);
  if (!fault) return result::forward(fault);
  apply_fault(ports_.fault_targets[*fault].kind, ports_.fault_targets[*fault].index, 0.0, false);
  return {};
}

void RobotCell::apply_fault(CellFault kind, std::size_t index, double value, bool active) {
  const bool on = active && value != 0.0;
  switch (kind) {
    case CellFault::Stuck:
      joint_faults_[index].stuck = on;
      return;
    case CellFault::Runaway:
      joint_faults_[index].runaway_rad_s = value;
      return;
    case CellFault::Overcurrent:
      joint_faults_[index].overcurrent = on;
      return;
    case CellFault::Slippery:
      arms_[index].friction_lost = value;
      return;
    case CellFault::DropIt:
      arms_[index].drops = on;
      return;
    case CellFault::DeadHand:
      arms_[index].dead_hand = on;
      return;
    case CellFault::CameraDead:
      camera_.faults.dead = on;
      return;
    case CellFault::CameraLoss:
      camera_.faults.loss = value;
      return;
    case CellFault::CameraGhosts:
      camera_.faults.ghosts = static_cast<std::size_t>(value);
      return;
    case CellFault::CameraOffsetX:
      camera_.faults.offset_x_m = kMPerMm * value;
      return;
    case CellFault::CameraOffsetY:
      camera_.faults.offset_y_m = kMPerMm * value;
      return;
    // Nobody moves what is in a hand or falls, and the end of the fault puts nothing back.
    case CellFault::ShiftX:
      if (on && objects_[index].state == ObjectState::Stands) shift(index, {kMPerMm * value, 0.0, 0.0});
      return;
    case CellFault::ShiftY:
      if (on && objects_[index].state == ObjectState::Stands) shift(index, {0.0, kMPerMm * value, 0.0});
      return;
    case CellFault::Block:
      to_block_[index] = on;
      blocked_[index] = false;
      put_blockages();
      changed_ = true;
      return;
    case CellFault::EmergencyStop:
      emergency_stop_ = on;
      return;
  }
}

}  // namespace stepwright::assemblies

#include "plant_models/assemblies/robot_cell_ports.h"

#include <string>
#include <utility>

namespace stepwright::assemblies {
namespace {

using core::PortKind;

class RobotCellPortList {
 public:
  explicit RobotCellPortList(const RobotCellParameters& parameters) : parameters_(parameters) {}

  RobotCellPorts build() {
    for (std::size_t arm = 0; arm < parameters_.arms.size(); ++arm) add_arm(arm, parameters_.arms[arm].name);
    sensor(CellSensor::EmergencyStop, 0, "estop_ok", PortKind::Bool,
           "off while the emergency stop is pressed");
    add_camera();
    for (std::size_t k = 0; k < parameters_.objects.size(); ++k) add_object(k, parameters_.objects[k].name);
    for (std::size_t k = 0; k < parameters_.blockages.size(); ++k) {
      const std::string number = std::to_string(k + 1);
      fault(CellFault::Block, k, "block_" + number, "1: something stands in this place");
      truth(CellTruth::Blocked, k, "blocked_" + number, "", "1: something stands in this place");
    }
    fault(CellFault::EmergencyStop, 0, "press_estop", "1: the emergency stop is pressed");
    add_judge();
    return std::move(ports_);
  }

 private:
  void actuator(CellActuator kind, std::size_t index, std::string name, PortKind port, std::string meaning) {
    ports_.actuators.push_back({std::move(name), port, std::move(meaning)});
    ports_.actuator_targets.push_back({kind, index});
  }
  void sensor(CellSensor kind, std::size_t index, std::string name, PortKind port, std::string meaning) {
    ports_.sensors.push_back({std::move(name), port, std::move(meaning)});
    ports_.sensor_targets.push_back({kind, index});
  }
  void truth(CellTruth kind, std::size_t index, std::string name, std::string unit, std::string meaning) {
    ports_.truths.push_back({std::move(name), std::move(unit), std::move(meaning)});
    ports_.truth_targets.push_back({kind, index});
  }
  void fault(CellFault kind, std::size_t index, std::string name, std::string meaning,
             FaultRange range = {}) {
    ports_.faults.push_back({std::move(name), "", std::move(meaning)});
    ports_.fault_targets.push_back({kind, index});
    ports_.fault_ranges.push_back(range);
  }

  void add_joint(std::size_t index, const std::string& name) {
    actuator(CellActuator::Joint, index, "set_" + name, PortKind::Count, "wanted angle, 0.0001 rad");
    sensor(CellSensor::Joint, index, "pos_" + name, PortKind::Count, "angle by the encoder, 0.0001 rad");
    truth(CellTruth::Joint, index, "true_" + name, "rad", "angle");
    fault(CellFault::Stuck, index, "stuck_" + name, "1: the joint stays where it is");
    fault(CellFault::Runaway, index, "runaway_" + name,
          "the drive has lost its position and turns at this speed, rad/s", {-3.0, 3.0, false});
    fault(CellFault::Overcurrent, index, "overcurrent_" + name, "1: the drive trips by its current");
  }

  void add_arm(std::size_t arm, const std::string& name) {
    actuator(CellActuator::Enable, arm, "enable_" + name, PortKind::Bool,
             "releases the arm's brakes; after a trip it has to be taken away once");
    for (std::size_t k = 0; k < kArmJoints; ++k)
      add_joint(arm * kArmJoints + k, name + "_" + std::to_string(k + 1));
    actuator(CellActuator::Grip, arm, "grip_" + name, PortKind::Count,
             "wanted opening of the hand, 0.1 mm; below an object's width it presses");
    sensor(CellSensor::Width, arm, "width_" + name, PortKind::Count, "opening of the hand, 0.1 mm");
    sensor(CellSensor::Ready, arm, "ready_" + name, PortKind::Bool, "the arm is enabled and follows");
    sensor(CellSensor::Tripped, arm, "trip_" + name, PortKind::Bool,
           "a drive has tripped, or the arm has run into something: it brakes until enable is taken away");
    sensor(CellSensor::Grasping, arm, "grasp_" + name, PortKind::Bool, "the fingers press on something");
    truth(CellTruth::Width, arm, "true_width_" + name, "m", "opening of the hand");
    truth(CellTruth::Held, arm, "held_" + name, "", "number of the object in the hand, from 1; 0: none");
    fault(CellFault::Slippery, arm, "slip_" + name, "share of the fingers' friction that is lost",
          {0.0, 1.0, false});
    fault(CellFault::DropIt, arm, "drop_" + name, "1: the hand loses what it holds, and takes nothing");
    fault(CellFault::DeadHand, arm, "dead_hand_" + name, "1: the fingers stay where they are");
  }

  void add_camera() {
    actuator(CellActuator::Trigger, 0, "camera_trigger", PortKind::Bool, "takes a picture when it comes on");
    sensor(CellSensor::Pictures, 0, "camera_pictures", PortKind::Count,
           "reports so far, without end from 0 anew");
    sensor(CellSensor::SeenCount, 0, "camera_seen", PortKind::Count, "objects in the last report");
    for (std::size_t k = 0; k < camera_slots(parameters_); ++k) {
      const std::string slot = "seen_" + std::to_string(k + 1);
      sensor(CellSensor::SeenKind, k, slot + "_kind", PortKind::Count,
             "1 cup, 2 can, 3 tray, 4 box; 0 nothing");
      sensor(CellSensor::SeenX, k, slot + "_x", PortKind::Count, "middle of its bottom, 0.1 mm");
      sensor(CellSensor::SeenY, k, slot + "_y", PortKind::Count, "middle of its bottom, 0.1 mm");
      sensor(CellSensor::SeenZ, k, slot + "_z", PortKind::Count, "middle of its bottom, 0.1 mm");
      sensor(CellSensor::SeenYaw, k, slot + "_yaw", PortKind::Count, "how it stands, 0.0001 rad");
    }
    fault(CellFault::CameraDead, 0, "camera_dead", "1: no report any more");
    fault(CellFault::CameraLoss, 0, "camera_loss", "share of objects that it does not see",
          {0.0, 1.0, false});
    fault(CellFault::CameraGhosts, 0, "camera_ghosts", "so many in each report that are not there",
          {0.0, 8.0, true});
    const FaultRange offset_mm{-200.0, 200.0, false};
    fault(CellFault::CameraOffsetX, 0, "camera_offset_x", "all poses are off by so many mm along x",
          offset_mm);
    fault(CellFault::CameraOffsetY, 0, "camera_offset_y", "all poses are off by so many mm along y",
          offset_mm);
  }

  void add_object(std::size_t k, const std::string& name) {
    truth(CellTruth::ObjectX, k, "x_" + name, "m", "middle of its bottom");
    truth(CellTruth::ObjectY, k, "y_" + name, "m", "middle of its bottom");
    truth(CellTruth::ObjectZ, k, "z_" + name, "m", "middle of its bottom");
    truth(CellTruth::ObjectYaw, k, "yaw_" + name, "rad", "how it stands");
    truth(CellTruth::ObjectState, k, "state_" + name, "", "0 stands, 1 is held, 2 falls");
    truth(CellTruth::ObjectOn, k, "on_" + name, "",
          "what it stands on: 0 the floor, 1 and so on fixed bodies, 100 and so on objects");
    const FaultRange shift_mm{-500.0, 500.0, false};
    fault(CellFault::ShiftX, k, "shift_x_" + name, "somebody moves it by so many mm along x, once", shift_mm);
    fault(CellFault::ShiftY, k, "shift_y_" + name, "somebody moves it by so many mm along y, once", shift_mm);
  }

  void add_judge() {
    const auto count = [&](IncidentKindName kind) {
      truth(CellTruth::Incidents, kind.index, kind.name, "", kind.meaning);
    };
    for (const IncidentKindName& kind : kKinds) count(kind);
    truth(CellTruth::SmallestGap, 0, "smallest_gap", "m", "least distance of the arms so far");
    truth(CellTruth::WorstTilt, 0, "worst_tilt", "rad", "the most that a hand with an object has tilted");
  }

  struct IncidentKindName {
    std::size_t index;
    const char* name;
    const char* meaning;
  };
  static constexpr IncidentKindName kKinds[] = {
      {0, "contacts_arm_arm", "how often the arms have touched"},
      {1, "contacts_arm_fixed", "how often an arm has run into something fixed"},
      {2, "contacts_arm_object", "how often an arm has touched an object that it does not hold"},
      {3, "contacts_object_object", "how often objects have touched that do not stand on one another"},
      {4, "contacts_object_fixed", "how often an object was in something that it does not stand on"},
      {5, "dropped", "how many objects have fallen by more than 10 mm"},
      {6, "slipped", "how often an object has slipped in a hand"}};

  const RobotCellParameters& parameters_;
  RobotCellPorts ports_;
};

}  // namespace

RobotCellPorts make_ports(const RobotCellParameters& parameters) {
  return RobotCellPortList(parameters).build();
}

core::PlantDescription describe_robot_cell(const RobotCellParameters&) {
  core::PlantDescription description;
  description.name = "robot_cell";
  return description;
}

}  // namespace stepwright::assemblies

#include "plant_models/assemblies/fleet_ports.h"

#include <string>
#include <utility>

namespace stepwright::assemblies {
namespace {

using core::PortKind;

class Builder {
 public:
  explicit Builder(const FleetParameters& parameters) : parameters_(parameters) {}

  FleetPorts build() {
    for (std::size_t i = 0; i < parameters_.starts.size(); ++i) add_vehicle(i, "v" + std::to_string(i + 1));
    sensor(FleetSensor::EmergencyStop, 0, "estop_ok", PortKind::Bool,
           "off while the emergency stop is pressed");
    for (std::size_t i = 0; i < parameters_.pallets.size(); ++i) add_pallet(i, "p" + std::to_string(i + 1));
    truth(FleetTruth::Contacts, 0, "contacts", "", "how often a vehicle has run into something");
    truth(FleetTruth::GreatestForce, 0, "greatest_force", "N",
          "the most that a vehicle was pressed with so far");
    truth(FleetTruth::Overlaps, 0, "overlaps", "",
          "pairs of vehicles whose exact outlines shared a point, counted in each step");
    truth(FleetTruth::ObstacleOverlaps, 0, "obstacle_overlaps", "",
          "outlines of vehicles that shared a point with a wall or a blocked place, counted in each step");
    truth(FleetTruth::SmallestGap, 0, "smallest_gap", "m", "least distance of two outlines so far");
    for (std::size_t i = 0; i < parameters_.blockages.size(); ++i) {
      fault(FleetFault::Block, i, "block_" + std::to_string(i + 1), "1: something stands in this place");
      truth(FleetTruth::Blocked, i, "blocked_" + std::to_string(i + 1), "",
            "1: something stands in this place");
    }
    fault(FleetFault::EmergencyStop, 0, "press_estop", "1: the emergency stop is pressed");
    return std::move(ports_);
  }

 private:
  void actuator(FleetActuator kind, std::size_t index, std::string name, PortKind port, std::string meaning) {
    ports_.actuators.push_back({std::move(name), port, std::move(meaning)});
    ports_.actuator_targets.push_back({kind, index});
  }
  void sensor(FleetSensor kind, std::size_t index, std::string name, PortKind port, std::string meaning) {
    ports_.sensors.push_back({std::move(name), port, std::move(meaning)});
    ports_.sensor_targets.push_back({kind, index});
  }
  void truth(FleetTruth kind, std::size_t index, std::string name, std::string unit, std::string meaning) {
    ports_.truths.push_back({std::move(name), std::move(unit), std::move(meaning)});
    ports_.truth_targets.push_back({kind, index});
  }
  void fault(FleetFault kind, std::size_t index, std::string name, std::string meaning,
             FaultRange range = {}) {
    ports_.faults.push_back({std::move(name), "", std::move(meaning)});
    ports_.fault_targets.push_back({kind, index});
    ports_.fault_ranges.push_back(range);
  }

  void add_vehicle(std::size_t i, const std::string& v) {
    actuator(FleetActuator::Enable, i, "enable_" + v, PortKind::Bool,
             "releases the spring brake of " + v + "; after a contact it has to be taken away once");
    actuator(FleetActuator::Speed, i, "set_speed_" + v, PortKind::Count,
             "wanted speed of the wheels of " + v + ", mm/s");
    actuator(FleetActuator::Lock, i, "set_lock_" + v, PortKind::Count,
             "wanted steering of " + v + ", 0.01 degrees; positive turns left");
    actuator(FleetActuator::Lift, i, "lift_" + v, PortKind::Bool,
             "lifts the forks of " + v + "; off: they come down");
    sensor(FleetSensor::X, i, "x_" + v, PortKind::Count, "place of " + v + " by its navigation, cm");
    sensor(FleetSensor::Y, i, "y_" + v, PortKind::Count, "place of " + v + " by its navigation, cm");
    sensor(FleetSensor::Heading, i, "heading_" + v, PortKind::Count,
           "heading of " + v + ", 0.01 degrees, -180 to 180");
    sensor(FleetSensor::Speed, i, "speed_" + v, PortKind::Count, "speed of the wheels of " + v + ", mm/s");
    sensor(FleetSensor::Lock, i, "lock_" + v, PortKind::Count, "steering of " + v + ", 0.01 degrees");
    sensor(FleetSensor::Lifted, i, "lifted_" + v, PortKind::Bool,
           "the forks of " + v + " are all the way up");
    sensor(FleetSensor::Lowered, i, "lowered_" + v, PortKind::Bool,
           "the forks of " + v + " are all the way down");
    sensor(FleetSensor::Loaded, i, "loaded_" + v, PortKind::Bool, v + " carries a pallet");
    sensor(FleetSensor::Bumper, i, "bumper_" + v, PortKind::Bool,
           v + " has run into something and brakes until enable is taken away");
    truth(FleetTruth::X, i, "true_x_" + v, "m", "place of " + v);
    truth(FleetTruth::Y, i, "true_y_" + v, "m", "place of " + v);
    truth(FleetTruth::Heading, i, "true_heading_" + v, "rad", "heading of " + v + ", not wrapped");
    truth(FleetTruth::Speed, i, "true_speed_" + v, "m/s", "speed of " + v + " over ground");
    truth(FleetTruth::Lock, i, "true_lock_" + v, "rad", "steering of " + v);
    truth(FleetTruth::LoadedWith, i, "load_" + v, "",
          "number of the pallet that " + v + " carries, 0 = none");
    fault(FleetFault::Dead, i, "dead_" + v, "1: " + v + " stands still for good and answers nothing");
    fault(FleetFault::Weak, i, "weak_" + v, "share of its force that the drive of " + v + " has left",
          {0.0, 1.0, false});
    fault(FleetFault::Slip, i, "slip_" + v, "share of the speed of " + v + " that the floor does not give",
          {0.0, 0.9, false});
    fault(FleetFault::StuckSteering, i, "stuck_steering_" + v,
          "1: the steering of " + v + " stays where it is");
    fault(FleetFault::FrozenPose, i, "frozen_pose_" + v,
          "1: the navigation of " + v + " goes on showing the same");
    fault(FleetFault::Drift, i, "drift_" + v, "the navigation of " + v + " walks away along x, cm/s",
          {-50.0, 50.0, false});
  }

  void add_pallet(std::size_t i, const std::string& p) {
    truth(FleetTruth::PalletX, i, "x_" + p, "m", "middle of the pallet " + p);
    truth(FleetTruth::PalletY, i, "y_" + p, "m", "middle of the pallet " + p);
    truth(FleetTruth::PalletAngle, i, "angle_" + p, "rad", "how far the pallet " + p + " is turned");
    truth(FleetTruth::PalletState, i, "state_" + p, "",
          "pallet " + p + ": 1 stands on the floor, 2 is carried");
  }

  const FleetParameters& parameters_;
  FleetPorts ports_;
};

}  // namespace

FleetPorts make_ports(const FleetParameters& parameters) {
  return Builder(parameters).build();
}

core::PlantDescription describe_fleet(const FleetParameters& p) {
  core::PlantDescription d;
  d.name = "fleet";
  for (std::size_t i = 0; i < p.starts.size(); ++i) {
    const std::string v = "v" + std::to_string(i + 1);
    d.forklifts.push_back({v, p.forklift.body.front_m, p.forklift.body.rear_m, p.forklift.body.width_m,
                           "true_x_" + v, "true_y_" + v, "true_heading_" + v, "true_lock_" + v, "load_" + v,
                           p.forklift.body.wheelbase_m});
  }
  for (std::size_t i = 0; i < p.pallets.size(); ++i) {
    const std::string name = "p" + std::to_string(i + 1);
    d.boxes.push_back(
        {name, kPalletLength_m, kPalletWidth_m, "state_" + name, "x_" + name, "y_" + name, "angle_" + name});
  }
  const auto add_block = [&d](const BlockParameters& block, std::string name, std::string there) {
    d.obstacles.push_back({std::move(name), block.pose.position.x, block.pose.position.y, block.pose.angle,
                           block.rectangle.size.x, block.rectangle.size.y, std::move(there)});
  };
  for (const BlockParameters& wall : p.walls) add_block(wall, "", "");
  for (std::size_t i = 0; i < p.blockages.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    add_block(p.blockages[i], "block_" + number, "blocked_" + number);
  }
  return d;
}

}  // namespace stepwright::assemblies

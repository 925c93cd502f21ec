#include "plant_models/assemblies/tugger_ports.h"

#include <string>
#include <utility>

namespace stepwright::assemblies {
namespace {

using core::PortKind;

class TuggerPortList {
 public:
  explicit TuggerPortList(const TuggerParameters& parameters) : parameters_(parameters) {}

  TuggerPorts build() {
    add_tractor();
    for (std::size_t k = 1; k <= most_trailers(parameters_); ++k) add_trailer(k, std::to_string(k));
    sensor(TuggerSensor::Trailers, 0, "trailers", PortKind::Count, "trailers that are coupled");
    sensor(TuggerSensor::Bumper, 0, "bumper", PortKind::Bool,
           "the train has run into something and brakes until enable is taken away");
    sensor(TuggerSensor::EmergencyStop, 0, "estop_ok", PortKind::Bool,
           "off while the emergency stop is pressed");
    sensor(TuggerSensor::WayFree, 0, "way_free", PortKind::Bool,
           "off while something that does not belong there is close in front of the tractor");
    for (std::size_t i = 0; i < parameters_.places.size(); ++i) {
      const std::string& name = parameters_.places[i].name;
      sensor(TuggerSensor::AtPlace, i, "at_" + name, PortKind::Bool,
             "the tractor's reference point is in " + name);
    }
    truth(TuggerTruth::Trailers, 0, "true_trailers", "", "trailers that are coupled");
    truth(TuggerTruth::Contacts, 0, "contacts", "", "how often the train has run into something");
    truth(TuggerTruth::SmallestGap, 0, "smallest_gap", "m",
          "least distance of the train to a wall, an obstacle or a blocked place so far");
    for (std::size_t i = 0; i < parameters_.blockages.size(); ++i) {
      fault(TuggerFault::Block, i, "block_" + std::to_string(i + 1), "1: something stands in this place");
      truth(TuggerTruth::Blocked, i, "blocked_" + std::to_string(i + 1), "",
            "1: something stands in this place");
    }
    add_faults();
    return std::move(ports_);
  }

 private:
  void actuator(TuggerActuator kind, std::string name, PortKind port, std::string meaning) {
    ports_.actuators.push_back({std::move(name), port, std::move(meaning)});
    ports_.actuator_targets.push_back({kind, 0});
  }
  void sensor(TuggerSensor kind, std::size_t index, std::string name, PortKind port, std::string meaning) {
    ports_.sensors.push_back({std::move(name), port, std::move(meaning)});
    ports_.sensor_targets.push_back({kind, index});
  }
  void truth(TuggerTruth kind, std::size_t index, std::string name, std::string unit, std::string meaning) {
    ports_.truths.push_back({std::move(name), std::move(unit), std::move(meaning)});
    ports_.truth_targets.push_back({kind, index});
  }
  void fault(TuggerFault kind, std::size_t index, std::string name, std::string meaning,
             FaultRange range = {}) {
    ports_.faults.push_back({std::move(name), "", std::move(meaning)});
    ports_.fault_targets.push_back({kind, index});
    ports_.fault_ranges.push_back(range);
  }

  void add_tractor() {
    actuator(TuggerActuator::Enable, "enable", PortKind::Bool,
             "releases the spring brake; after a contact it has to be taken away once");
    actuator(TuggerActuator::Speed, "set_speed", PortKind::Count, "wanted speed of the wheels, mm/s");
    actuator(TuggerActuator::Lock, "set_lock", PortKind::Count,
             "wanted steering, 0.01 degrees; positive turns left");
    sensor(TuggerSensor::X, 0, "x", PortKind::Count, "place of the tractor by its navigation, cm");
    sensor(TuggerSensor::Y, 0, "y", PortKind::Count, "place of the tractor by its navigation, cm");
    sensor(TuggerSensor::Heading, 0, "heading", PortKind::Count,
           "heading of the tractor, 0.01 degrees, -180 to 180");
    sensor(TuggerSensor::Speed, 0, "speed", PortKind::Count, "speed of the wheels, mm/s");
    sensor(TuggerSensor::Lock, 0, "lock", PortKind::Count, "steering, 0.01 degrees");
    truth(TuggerTruth::X, 0, "true_x", "m", "place of the tractor");
    truth(TuggerTruth::Y, 0, "true_y", "m", "place of the tractor");
    truth(TuggerTruth::Heading, 0, "true_heading", "rad", "heading of the tractor, not wrapped");
    truth(TuggerTruth::Speed, 0, "true_speed", "m/s", "speed of the tractor over ground");
    truth(TuggerTruth::Lock, 0, "true_lock", "rad", "steering of the tractor");
  }

  void add_trailer(std::size_t k, const std::string& number) {
    sensor(TuggerSensor::Hitch, k, "hitch_" + number, PortKind::Count,
           "how far the link in front of trailer " + number + " is turned to the left of it, 0.01 degrees");
    truth(TuggerTruth::X, k, "true_x_" + number, "m", "middle of trailer " + number);
    truth(TuggerTruth::Y, k, "true_y_" + number, "m", "middle of trailer " + number);
    truth(TuggerTruth::Heading, k, "true_heading_" + number, "rad",
          "heading of trailer " + number + ", not wrapped");
    truth(TuggerTruth::LinkState, k, "true_state_" + number, "",
          "trailer " + number + ": 0 is not there, 1 is coupled, 2 was left standing");
  }

  void add_faults() {
    const auto most = static_cast<double>(most_trailers(parameters_));
    fault(TuggerFault::EmergencyStop, 0, "press_estop", "1: the emergency stop is pressed");
    fault(TuggerFault::Dead, 0, "dead", "1: the tractor stands still for good and answers nothing");
    fault(TuggerFault::Weak, 0, "weak", "share of its force that the drive has left", {0.0, 1.0, false});
    fault(TuggerFault::Slip, 0, "slip", "share of the speed that the floor does not give", {0.0, 0.9, false});
    fault(TuggerFault::StuckSteering, 0, "stuck_steering", "1: the steering stays where it is");
    fault(TuggerFault::FrozenPose, 0, "frozen_pose", "1: the navigation goes on showing the same");
    fault(TuggerFault::Drift, 0, "drift", "the navigation walks away along x, cm/s", {-50.0, 50.0, false});
    fault(TuggerFault::LeaveTrailers, 0, "leave_trailers",
          "so many trailers stay coupled, the others are left where they are", {0.0, most, true});
    fault(TuggerFault::CoupleTrailers, 0, "couple_trailers",
          "so many trailers are coupled in all, the new ones in line behind the last; at rest only",
          {0.0, most, true});
  }

  const TuggerParameters& parameters_;
  TuggerPorts ports_;
};

}  // namespace

TuggerPorts make_ports(const TuggerParameters& parameters) {
  return TuggerPortList(parameters).build();
}

core::PlantDescription describe_tugger(const TuggerParameters& p) {
  core::PlantDescription d;
  d.name = "tugger";
  const auto add_regions = [&d](const std::vector<FloorPolygon>& polygons, core::RegionKind kind,
                                const auto& live) {
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      core::RegionDescription region{polygons[i].name, kind, {}, {}, live(i)};
      for (const body2d::Vec2 corner : polygons[i].ring) {
        region.x.push_back(corner.x);
        region.y.push_back(corner.y);
      }
      d.regions.push_back(std::move(region));
    }
  };
  const auto always = [](std::size_t) { return std::string(); };
  add_regions(p.walls, core::RegionKind::Wall, always);
  add_regions(p.obstacles, core::RegionKind::Obstacle, always);
  add_regions(p.places, core::RegionKind::Place, [&](std::size_t i) { return "at_" + p.places[i].name; });
  add_regions(p.blockages, core::RegionKind::Blockage,
              [](std::size_t i) { return "blocked_" + std::to_string(i + 1); });
  d.links.push_back({"tractor", p.links.length_m, p.links.width_m, "true_x", "true_y", "true_heading", ""});
  for (std::size_t k = 1; k <= most_trailers(p); ++k) {
    const std::string number = std::to_string(k);
    d.links.push_back({"trailer_" + number, p.links.length_m, p.links.width_m, "true_x_" + number,
                       "true_y_" + number, "true_heading_" + number, "true_state_" + number});
  }
  return d;
}

}  // namespace stepwright::assemblies

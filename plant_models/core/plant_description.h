#pragma once

// Description of a plant for viewers, who draw it without knowing which plant it is. Plain data, constant
// while the plant lives; any thread. Invariant: every name refers to a port or a truth of the same plant, so
// that live values can be looked up.

#include <cstdint>
#include <string>
#include <vector>

namespace stepwright::core {

struct TankDescription {
  std::string name;  // "a1"
  std::string label;
  double capacity_l = 0.0;
  double overflow_percent = 100.0;  // above this level liquid leaves through the overflow
  double position = 0.0;            // on the track, in its unit; for a tank on a vehicle: at start
  std::string vehicle;              // name of the vehicle that carries it; empty = it stands still
  std::string level_truth;          // truth with its level in percent
  std::string sensor;               // level sensor; empty = none
};

struct PumpDescription {
  std::string name;      // "b1"
  std::string actuator;  // port that switches it on
  std::string speed_truth;
  std::string flow_truth;
};

// A pipe carries liquid from tank to tank. `at_place`: connected only while the vehicle stands there.
struct PipeDescription {
  std::string from;  // tank name
  std::string to;    // tank name
  std::string pump;  // empty = gravity (return and overflow lines)
  std::string at_place;
};

struct PlaceDescription {
  std::string name;
  double position = 0.0;
  double half_width = 0.0;    // the switch is closed within position +- half_width
  std::string switch_sensor;  // port
};

struct VehicleDescription {
  std::string name;
  std::string position_truth;
  std::string speed_truth;
  std::string drive_left;   // actuator
  std::string drive_right;  // actuator
  double track_min = 0.0;   // end stops
  double track_max = 0.0;
  std::vector<PlaceDescription> places;
};

// An analogue sensor and its static calibration: counts = counts_at_zero + counts_per_unit * value.
struct SensorDescription {
  std::string name;  // port
  std::string unit;
  std::string measures;  // truth that it stands for
  double counts_at_zero = 0.0;
  double counts_per_unit = 0.0;
};

// A belt or a chute seen from above, m.
struct BeltDescription {
  std::string name;
  std::string actuator;     // port; empty = it always runs
  std::string speed_truth;  // empty = constant
  double low_x = 0.0;
  double low_y = 0.0;
  double high_x = 0.0;
  double high_y = 0.0;
  double direction_x = 0.0;  // of running, length 1
  double direction_y = 0.0;
};

// A photo-eye and what it looks along; both ends alike for one that looks down at a point.
struct BeamDescription {
  std::string name;  // port
  double from_x = 0.0;
  double from_y = 0.0;
  double to_x = 0.0;
  double to_y = 0.0;
};

// A paddle that is pushed out and comes back.
struct PusherDescription {
  std::string name;
  std::string actuator;      // port
  std::string travel_truth;  // how far it is out, m
  double home_x = 0.0;       // middle of the paddle
  double home_y = 0.0;
  double length = 0.0;  // along x
  double thickness = 0.0;
  double direction_x = 0.0;  // of pushing, length 1
  double direction_y = 0.0;
  double stroke = 0.0;
};

struct BoxDescription {
  std::string name;
  double length = 0.0;
  double width = 0.0;
  std::string state_truth;  // 1 = on the line
  std::string x_truth;
  std::string y_truth;
  std::string angle_truth;  // rad
};

// A vehicle that moves freely, seen from above; its reference point is at the truths, m.
struct ForkliftDescription {
  std::string name;
  double front = 0.0;  // from the reference point to the tips of the forks
  double rear = 0.0;
  double width = 0.0;
  std::string x_truth;
  std::string y_truth;
  std::string heading_truth;  // rad
  std::string lock_truth;     // steering, rad
  std::string load_truth;     // number of the box that it carries, from 1; 0 = none
  double wheelbase = 0.0;     // the steered axle is so far behind the reference point
};

// A rectangle that nothing passes.
struct ObstacleDescription {
  std::string name;  // the fault that puts it there; empty = it always stands there
  double x = 0.0;    // its middle
  double y = 0.0;
  double angle = 0.0;
  double length = 0.0;
  double width = 0.0;
  std::string there_truth;  // 1 = it stands there; empty = always
};

enum class RegionKind : std::uint8_t {
  Wall,  // nothing passes it from the inside
  Obstacle,
  Place,
  Blockage,  // stands there now and then
};

// A polygon on the floor, m.
struct RegionDescription {
  std::string name;
  RegionKind kind = RegionKind::Obstacle;
  std::vector<double> x;  // of its corners
  std::vector<double> y;
  std::string live;  // of a place: the port that says that the vehicle is in it; of a blockage: the truth
                     // that is 1 while it stands there
};

// A link of a train, a box around its middle, m.
struct LinkDescription {
  std::string name;
  double length = 0.0;
  double width = 0.0;
  std::string x_truth;
  std::string y_truth;
  std::string heading_truth;  // rad
  std::string state_truth;    // 0 = it is not there, 1 = coupled, 2 = left standing; empty = it is there
};

struct PlantDescription {
  std::string name;
  std::vector<TankDescription> tanks;
  std::vector<PumpDescription> pumps;
  std::vector<PipeDescription> pipes;
  std::vector<VehicleDescription> vehicles;
  std::vector<SensorDescription> sensors;
  std::vector<BeltDescription> belts;
  std::vector<BeamDescription> beams;
  std::vector<PusherDescription> pushers;
  std::vector<BoxDescription> boxes;
  std::vector<ForkliftDescription> forklifts;
  std::vector<ObstacleDescription> obstacles;
  std::vector<RegionDescription> regions;
  std::vector<LinkDescription> links;  // the one in front first
};

// One JSON object with the field names above, for a viewer in another process.
std::string to_json(const PlantDescription& description);

}  // namespace stepwright::core

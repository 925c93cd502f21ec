#pragma once

// The description from which a viewer draws its mimic of the plant: what there is, what is connected to what
// and which live point animates it. It says nothing about pixels; the client computes the drawing.
//
// A point is a live value with a name ("a1.level"); elements refer to points by their id, and the values of
// all points travel in every snapshot in the order of `points`. An element whose point id is empty is drawn
// without that animation.
//
// Plain values; no thread rule.

#include <cstdint>
#include <string>
#include <vector>

#include "hmi_web/protocol/floor.h"

namespace stepwright::protocol {

struct Point {
  std::string id;
  std::string label;
  std::string unit;    // "%", "m", "" for a switch
  bool trend = false;  // draw it over time
};

// A place on the track at which vehicles stop.
struct Place {
  std::string id;
  std::string label;
  double position = 0;       // along the track, in the unit of the vehicles' position point
  std::string switch_point;  // its microswitch
};

struct Vehicle {
  std::string id;
  std::string label;
  std::string position_point;
  std::string left_point;  // its drives
  std::string right_point;
};

enum class TankSide : std::uint8_t { Above, Below, OnVehicle };

// A tank stands above or below the track at a place, or rides on a vehicle.
struct Tank {
  std::string id;
  std::string label;
  TankSide side = TankSide::Below;
  std::string at;           // a place or a vehicle
  std::string level_point;  // measured, percent
  std::string truth_point;  // of a simulated plant, percent
  double low_percent = 0;   // below: abnormal (0 = no limit)
  double high_percent = 0;  // above: abnormal (0 = no limit)
};

// Drawn once, beside the tank from which its pipes lead.
struct Pump {
  std::string id;
  std::string label;
  std::string running_point;  // the command, 0 or 1
  std::string flow_point;     // of a simulated plant, litres per second
};

// Carries liquid from tank to tank while its pump runs; without a pump by gravity.
struct Pipe {
  std::string from;
  std::string to;
  std::string pump;
  std::string at_place;  // connected only while the vehicle stands there; empty = always
};

// A belt or a chute seen from above; lengths and places of all that follows are metres in one plane.
struct Belt {
  std::string id;
  std::string label;
  std::string running_point;  // the command; empty = it always runs
  double low_x = 0;
  double low_y = 0;
  double high_x = 0;
  double high_y = 0;
  double direction_x = 0;  // of running, length 1
  double direction_y = 0;
};

// A photo-eye and what it looks along.
struct Beam {
  std::string id;
  std::string dark_point;  // something is there
  double from_x = 0;
  double from_y = 0;
  double to_x = 0;
  double to_y = 0;
};

// A paddle that is pushed out and comes back.
struct Pusher {
  std::string id;
  std::string label;
  std::string out_point;     // the command
  std::string travel_point;  // of a simulated plant, m; without it the paddle is drawn where it is told to be
  double home_x = 0;         // middle of the paddle
  double home_y = 0;
  double length = 0;  // along x
  double thickness = 0;
  double direction_x = 0;  // of pushing, length 1
  double direction_y = 0;
  double stroke = 0;
};

// Of a simulated plant: drawn while its state is 1.
struct Box {
  std::string id;
  std::string label;
  double length = 0;
  double width = 0;
  std::string state_point;
  std::string x_point;
  std::string y_point;
  std::string angle_point;  // rad
};

struct Synoptic {
  std::vector<Point> points;
  std::vector<Place> places;
  std::vector<Vehicle> vehicles;
  std::vector<Tank> tanks;
  std::vector<Pump> pumps;
  std::vector<Pipe> pipes;
  std::vector<Belt> belts;
  std::vector<Beam> beams;
  std::vector<Pusher> pushers;
  std::vector<Box> boxes;
  Floor floor;
};

}  // namespace stepwright::protocol

#pragma once

// Problem of a fleet: a map, vehicles, places, loads to be carried, drives, and constraints on their times
// (Pecora and Cirillo 2012, definition 2). supervisor/doc/fleet_problems.md describes the file.
//
// Values; any thread may read. Indices are those of the problem's vectors. Each thing knows its key in
// the file, so that what turns out wrong with it later is said with its place.
//
//   const MissionLocation& dock = problem.locations[problem.goals[0].from];

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/envelope/grow_envelope.h"
#include "supervisor/fleet/lattice/vehicle_model.h"
#include "supervisor/fleet/schedule/problem.h"
#include "supervisor/geometry/path.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::fleet {

struct VehicleClass {
  std::string name;
  VehicleModel model;
  std::string key;  // in the file: "vehicles[2]"
};

struct MissionLocation {
  std::string name;
  geometry::Pose pose;
  std::chrono::milliseconds service{0};  // of each pick-up and set-down there
  std::string key;                       // in the file: "vehicles[2]"
};

// One stop of a route that an operator has fixed.
struct HandStop {
  bool pick_up = true;  // otherwise set-down
  std::size_t goal = 0;
  std::uint32_t amount = 0;
};

struct MissionVehicle {
  std::string name;
  std::size_t vehicle_class = 0;
  SpeedLimits speed{.min_mps = 0.0, .max_mps = 1.5};
  geometry::Pose start;
  std::uint32_t capacity = 1;
  std::chrono::milliseconds available{0};  // it does not leave its start before
  std::vector<HandStop> route = {};        // fixed by an operator; empty: free
  bool route_is_whole = true;              // nothing comes after `route`; otherwise it is the beginning
  // The way to `start` for a vehicle that stands elsewhere: it ends there. What is planned comes behind it.
  geometry::Path lead_in = {};
  std::optional<geometry::Path> path = {};          // drawn or recorded: it drives this and nothing else
  std::optional<TrajectoryEnvelope> envelope = {};  // given: nothing else of the vehicle is known
  std::string key;                                  // in the file: "vehicles[2]"
};

// A goal <k, s, g>: `amount` loads from `from` to `to`.
struct MissionGoal {
  std::string name;
  std::uint32_t amount = 1;
  std::size_t from = 0;
  std::size_t to = 0;
  bool divisible = true;
  std::optional<std::size_t> vehicle = {};            // fixed by an operator
  std::vector<std::size_t> after = {};                // the same vehicle carries these goals before, in full
  std::optional<std::chrono::milliseconds> due = {};  // later is tardy; no constraint
  std::string key;                                    // in the file: "vehicles[2]"
};

// The vehicle drives there, after all that it carries, in the order of the file.
struct MissionTask {
  std::string name;
  std::size_t vehicle = 0;
  std::size_t location = 0;
  std::string key;  // in the file: "vehicles[2]"
};

enum class Moment : std::uint8_t {
  TimeZero,
  VehicleStart,    // its plan begins: the entry of its first polygon
  VehicleEnd,      // it has left its initial position: the exit of its first polygon
  VehicleArrival,  // the exit of its last polygon
  GoalStart,       // a vehicle stands at `from` and begins to load; of each trip
  GoalEnd,         // it has unloaded at `to`; of each trip
  TaskStart,       // the vehicle stands at the task's location
  TaskEnd,         // and has been served there
};

struct MomentRef {
  Moment moment = Moment::TimeZero;
  std::size_t index = 0;  // of the vehicle, goal or task
};

// least <= t(to) - t(from) <= most; distances of the horizon (100,000 s) and above bind nothing.
struct MissionConstraint {
  std::string name;
  MomentRef from;
  MomentRef to;
  Bounds distance;
  std::string key;  // in the file: "vehicles[2]"
};

struct MissionProblem {
  std::string file;
  std::string text;  // of the file
  OccupancyGrid map{{.resolution_m = 0.2, .origin = {}, .columns = 1, .rows = 1}};
  std::vector<VehicleClass> classes;
  std::vector<MissionVehicle> vehicles;
  std::vector<MissionLocation> locations;  // a task's own pose is one without a name of the file
  std::vector<MissionGoal> goals;
  std::vector<MissionTask> tasks;
  std::vector<MissionConstraint> constraints;
};

// Where in the problem's file a key stands.
result::Location place_of(const MissionProblem& problem, const std::string& key);

}  // namespace stepwright::fleet

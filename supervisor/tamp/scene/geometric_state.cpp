#include "supervisor/tamp/scene/geometric_state.h"

#include <bit>
#include <utility>

namespace stepwright::tamp::scene {

namespace {

class Mixer {
 public:
  void add(std::uint64_t number) {
    hash_ ^= number + 0x9E3779B97F4A7C15U + (hash_ << 6U) + (hash_ >> 2U);
    hash_ = (hash_ ^ (hash_ >> 30U)) * 0xBF58476D1CE4E5B9U;
    hash_ = (hash_ ^ (hash_ >> 27U)) * 0x94D049BB133111EBU;
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(int number) { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(number))); }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0x5DEECE66DU;
};

}  // namespace

GeometricState initial_state(const RobotCell& cell) {
  GeometricState state;
  for (const ArmModel& arm : cell.arms)
    state.arms.push_back(
        {arm.home, cell.robot.coordinates[static_cast<std::size_t>(arm.gripper)].upper, -1, -1, {}});
  for (const Thing& thing : cell.things) state.things.push_back({thing.start, -1, 0.0});
  return state;
}

std::uint64_t fingerprint(const GeometricState& state) {
  Mixer mixer;
  for (const ArmState& arm : state.arms) {
    for (const double value : arm.at) mixer.add(value);
    mixer.add(arm.half_open_m);
    mixer.add(arm.holds);
    mixer.add(arm.near);
    for (const motion::Configuration& each : arm.line)
      for (const double value : each) mixer.add(value);
  }
  for (const ThingState& thing : state.things) {
    for (const double value :
         {thing.pose.x_m, thing.pose.y_m, thing.pose.z_m, thing.pose.angle_rad, thing.hand_rad})
      mixer.add(value);
    mixer.add(thing.holder);
  }
  return mixer.hash();
}

std::uint64_t fingerprint_around(const GeometricState& state, int arm, double half_open_m) {
  Mixer mixer;
  mixer.add(arm);
  mixer.add(half_open_m);
  for (std::size_t k = 0; k < state.arms.size(); ++k) {
    if (static_cast<int>(k) == arm) continue;
    for (const double value : state.arms[k].at) mixer.add(value);
    mixer.add(state.arms[k].half_open_m);
  }
  for (const ThingState& thing : state.things) {
    mixer.add(thing.holder);
    if (thing.holder >= 0) {
      mixer.add(thing.hand_rad);
    } else {
      for (const double value : {thing.pose.x_m, thing.pose.y_m, thing.pose.z_m, thing.pose.angle_rad})
        mixer.add(value);
    }
  }
  return mixer.hash();
}

std::vector<double> values_of(const RobotCell& cell, const GeometricState& state) {
  std::vector<double> values = cell.rest;
  for (std::size_t k = 0; k < cell.arms.size(); ++k) {
    for (std::size_t j = 0; j < state.arms[k].at.size(); ++j)
      values[static_cast<std::size_t>(cell.arms[k].coordinates[j])] = state.arms[k].at[j];
    values[static_cast<std::size_t>(cell.arms[k].gripper)] = state.arms[k].half_open_m;
  }
  return values;
}

Surroundings surroundings(const RobotCell& cell, const GeometricState& state, double shrunk_m) {
  Surroundings around;
  for (const Furniture& each : cell.furniture)
    around.world.obstacles.push_back(obstacle_of(each.name, each.form, each.pose));
  for (std::size_t k = 0; k < cell.things.size(); ++k) {
    const ThingState& thing = state.things[k];
    if (thing.holder < 0) {
      around.world.obstacles.push_back(obstacle_of(cell.things[k].name, cell.things[k].form, thing.pose));
      continue;
    }
    // The tool stands above the thing, turned: seen from it the thing hangs below.
    const motion::Transform tool = tool_pose(0.0, 0.0, cell.tool_above(static_cast<int>(k)), thing.hand_rad);
    around.held.push_back(
        held_thing(cell, k, cell.arms[static_cast<std::size_t>(thing.holder)], inverse(tool), shrunk_m));
  }
  return around;
}

}  // namespace stepwright::tamp::scene

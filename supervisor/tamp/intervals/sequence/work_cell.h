#pragma once

// Problem for the intervals: a cell with arms, grasps, regions and objects, and a sequence of actions on
// them, as a task planner proposes it. Nothing of it is a path; poses are of objects, with the angle about
// the vertical. Metres, radians. Values; a reach is not owned and outlives the cell.
//
//   WorkCell cell;
//   cell.arms = {{"right", &right_reach}};
//   cell.grasps = {{.name = "top", .height_m = 0.34}};
//   cell.regions = {{.name = "tray1", .x_m = 0.5, .y_m = -0.2, .size_x_m = 0.3, .size_y_m = 0.3}};
//   cell.objects = {{.name = "cup1", .start = {0.6, 0.25, 0.1, 0.0}}};
//   const std::vector<Action> sequence = {pick(0, 0), place(0, 0, 0, std::numbers::pi)};
//   if (auto sound = validate(cell, sequence); !sound) ...

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/tamp/intervals/reach/exact_reach.h"
#include "supervisor/tamp/intervals/reach/reach_bounds.h"

namespace stepwright::tamp {

struct ObjectPose {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0, angle_rad = 0.0;
};

struct AngleRange {
  double low_rad = 0.0, high_rad = 0.0;  // anticlockwise from low to high
};

struct Arm {
  std::string name;
  const ReachBounds* reach = nullptr;
  const ExactReach* exact = nullptr;  // none: nothing is proved to be within reach
};

// The hand above the object. With `radius_m` its axis passes beside the object's origin by up to that.
struct Grasp {
  std::string name;
  double height_m = 0.0;  // of the tool above the object's origin
  double radius_m = 0.0;
  std::vector<AngleRange> angles;  // of the hand, seen from the object; empty: any
};

// A rectangle at a height, whose x axis heads there.
struct Region {
  std::string name;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  // its middle; z_m is where the origin of what stands on it is
  double size_x_m = 0.0, size_y_m = 0.0;
  double heading_rad = 0.0;
};

struct Object {
  std::string name;
  ObjectPose start;
  double height_m = 0.0;  // what is stacked on it has its origin that much above its own
};

enum class ActionKind : std::uint8_t { Pick, Place, MoveAway };

// At the end of a place: the object lies at least `distance_m` beyond the other one in this direction.
struct Beyond {
  std::size_t object = 0;
  double direction_rad = 0.0;
  double distance_m = 0.0;
};

// Numbers are places in the lists of the cell.
struct Action {
  ActionKind kind = ActionKind::MoveAway;
  std::size_t arm = 0;
  std::size_t object = 0;
  std::size_t grasp = 0;              // of a pick
  std::optional<std::size_t> region;  // of a place: one of the two
  std::optional<std::size_t> on;      // another object
  std::optional<double> final_angle_rad = {};
  std::vector<Beyond> beyond = {};
};

inline Action pick(std::size_t arm, std::size_t object, std::size_t grasp = 0) {
  return {ActionKind::Pick, arm, object, grasp, std::nullopt, std::nullopt};
}
inline Action place(std::size_t arm, std::size_t object, std::size_t region,
                    std::optional<double> final_angle_rad = {}) {
  return {ActionKind::Place, arm, object, 0, region, std::nullopt, final_angle_rad};
}
inline Action stack(std::size_t arm, std::size_t object, std::size_t on,
                    std::optional<double> final_angle_rad = {}) {
  return {ActionKind::Place, arm, object, 0, std::nullopt, on, final_angle_rad};
}
inline Action move_away(std::size_t arm) {
  return {ActionKind::MoveAway, arm, 0, 0, std::nullopt, std::nullopt};
}

struct WorkCell {
  std::vector<Arm> arms;
  std::vector<Grasp> grasps;
  std::vector<Region> regions;
  std::vector<Object> objects;
};

// No position is further from the origin of the cell than this.
inline constexpr double kFarthest_m = 10.0;

// "right places cup1 on tray1".
std::string text_of(const WorkCell& cell, const Action& action);

// I0101: a number that is out of range; I0102: an action that cannot follow on those before it (picked twice,
// placed without being held, a hand that is full, a place on something held); I0103: a name or number of a
// list that there is not. Everything that is wrong is said; `where` is the file of the messages, `actions_at`
// where each action stands in it.
[[nodiscard]] result::Result<void> validate(const WorkCell& cell, std::span<const Action> sequence,
                                            const std::string& where = {},
                                            std::span<const result::Location> actions_at = {});

}  // namespace stepwright::tamp

#pragma once

// The solids of the robot cell's objects: cups and cans are cylinders, a box is a box, a tray a plate with a
// handle at each end. Pure; any thread, no heap.
//
//   const ObjectShape shape = shape_of(figures);
//   for (const ObjectPart& part : shape.parts()) ... placed(part, pose)

#include <array>
#include <cstddef>
#include <span>

#include "plant_models/assemblies/robot_cell_parameters.h"

namespace stepwright::assemblies {

// Where an object is. Its origin is the middle of its bottom, and it is upright.
struct ObjectPose {
  Vec3 place;
  double yaw_rad = 0.0;

  Frame frame() const { return {turn_upright(yaw_rad), place}; }
  friend bool operator==(const ObjectPose&, const ObjectPose&) = default;
};

struct ObjectPart {
  ConvexSolid solid;
  Vec3 middle;           // in the object's frame
  Vec3 size_m;           // full sides; of a cylinder x and y are its diameter
  bool grip = false;     // fingers hold it there
  bool surface = false;  // things stand on its top

  double top_m() const { return middle.z + 0.5 * size_m.z; }
};

class ObjectShape {
 public:
  std::span<const ObjectPart> parts() const { return {parts_.data(), count_}; }
  double mass_kg = 0.0;
  double height_m = 0.0;

  void add(const ObjectPart& part) { parts_[count_++] = part; }

 private:
  std::array<ObjectPart, 3> parts_{};
  std::size_t count_ = 0;
};

ObjectShape shape_of(const ObjectFigures& figures);

inline PlacedSolid placed(const ObjectPart& part, const ObjectPose& pose) {
  return {part.solid, pose.frame() * Frame{{}, part.middle}};
}

}  // namespace stepwright::assemblies

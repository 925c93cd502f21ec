#pragma once

// The objects of a robot cell: where they stand, what stands on what, how they fall. Upright always; a fall
// ends on the highest surface below the object's middle, without a bounce.
//
// Thread rule: one thread at a time; nothing is allocated after the constructor. Invariants: an object is
// held, falls, or stands on a surface; what stands on an object goes with it.
//
//   CellObjects objects(parameters);
//   objects.move(cup, pose);                    // with all that stands on it
//   objects.let_go(cup, velocity_m_s);          // it is set down, or falls
//   objects.step(0.005);

#include <cstdint>
#include <span>
#include <vector>

#include "plant_models/assemblies/robot_cell_shapes.h"

namespace stepwright::assemblies {

enum class ObjectState : std::uint8_t { Stands, Held, Falls };

// What an object stands on, as one number: 0 the floor, 1 and so on the fixed bodies, from kOnObject on
// objects.
inline constexpr int kOnFloor = 0;
inline constexpr int kOnObject = 100;

struct CellObject {
  ObjectShape shape;
  ObjectPose pose;
  ObjectState state = ObjectState::Stands;
  int support = kOnFloor;  // of one that stands; else of where it stood last
  Vec3 velocity_m_s;       // of one that falls
  double fell_from_m = 0.0;
};

// A fall that has ended.
struct Landing {
  std::size_t object = 0;
  int support = kOnFloor;
  double height_m = 0.0;
};

class CellObjects {
 public:
  // Each on what is highest where it stands, in the order of the parameters.
  explicit CellObjects(const RobotCellParameters& parameters);

  std::span<const CellObject> all() const { return objects_; }
  const CellObject& operator[](std::size_t object) const { return objects_[object]; }
  // `object` stands on `below`, or on something that does.
  bool is_on(std::size_t object, std::size_t below) const;
  // Of an object and of all that stands on it.
  double mass_kg(std::size_t object) const;
  // The highest surface below a place, for `object`; the floor if there is nothing else.
  double surface_below_m(std::size_t object, Vec3 place) const;

  void move(std::size_t object, const ObjectPose& pose);
  void hold(std::size_t object);
  void let_go(std::size_t object, Vec3 velocity_m_s);
  // What stands on a held object slides back where it is accelerated by more than friction gives.
  void shake(std::size_t object, Vec3 acceleration_m_s2, double step_s);
  // As it was kept; false, and nothing happens, if it cannot have been.
  bool restore(std::size_t object, const ObjectPose& pose, ObjectState state, int support);

  // Falls go on, and what has lost its support begins to fall. The landings of this step; true if anything
  // moved.
  bool step(double step_s);
  std::span<const Landing> landings() const { return {landings_.data(), landed_}; }

 private:
  struct Surface {
    int support = kOnFloor;
    double top_m = 0.0;
  };
  Surface surface_below(std::size_t object, Vec3 place) const;
  bool is_supported(std::size_t object) const;
  void fall(std::size_t object, double step_s);
  void stand(std::size_t object, const Surface& on);

  std::vector<FixedBody> fixed_;
  std::vector<CellObject> objects_;
  std::vector<Landing> landings_;
  std::size_t landed_ = 0;
};

}  // namespace stepwright::assemblies

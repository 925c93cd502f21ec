#pragma once

// The camera of a robot cell: a picture when it is triggered, and some time later a report of what is in it,
// with noise, with objects that it has not seen and with ones that are not there. It tells what kind an
// object is, not which one, and in no order. A blockage that stands is one of the kind Obstacle.
//
// Thread rule: one thread at a time; nothing is allocated after the constructor. The n-th report of a seed is
// the same whatever was asked before it.
//
//   camera.trigger(now_s, objects, blocked);
//   camera.step(now_s);
//   for (const Sighting& seen : camera.report()) ...

#include <cstdint>
#include <span>
#include <vector>

#include "plant_models/assemblies/robot_cell_objects.h"
#include "plant_models/core/counter_random.h"

namespace stepwright::assemblies {

struct Sighting {
  ObjectKind kind = ObjectKind::Cup;
  ObjectPose pose;

  friend bool operator==(const Sighting&, const Sighting&) = default;
};

// What is wrong with it.
struct CameraFaults {
  bool dead = false;       // no picture any more
  double loss = 0.0;       // 0..1, beside its own
  std::size_t ghosts = 0;  // in each picture, beside its own
  double offset_x_m = 0.0;
  double offset_y_m = 0.0;
};

class CellCamera {
 public:
  explicit CellCamera(const RobotCellParameters& parameters);

  // Nothing while a picture is under way. Falling objects are not in it.
  // `blocked`: of each blockage whether it stands; beyond its end none does.
  void trigger(double now_s, std::span<const CellObject> objects, std::span<const bool> blocked = {});
  void step(double now_s);

  std::span<const Sighting> report() const { return {report_.data(), reported_}; }
  std::int64_t pictures() const { return pictures_; }  // that have been reported
  bool busy() const { return due_s_ >= 0.0; }
  CameraFaults faults;

 private:
  Sighting seen(const Sighting& truth, std::uint64_t stream) const;
  Sighting ghost(std::uint64_t stream) const;
  core::CounterRandom random(std::uint64_t stream) const { return {seed_, kStreams + stream}; }
  void shuffle();

  static constexpr std::uint64_t kStreams = 1000;
  CameraFigures figures_;
  std::uint64_t seed_;
  std::vector<ObjectKind> kinds_;
  std::vector<Sighting> blockages_;
  std::vector<Sighting> picture_;  // under way
  std::vector<Sighting> report_;
  std::size_t taken_ = 0;
  std::size_t reported_ = 0;
  std::int64_t pictures_ = 0;
  double due_s_ = -1.0;  // below 0: none is under way
};

}  // namespace stepwright::assemblies

#pragma once

// Checks many configurations of an arm at once for collisions: of the robot's spheres with the world, and
// with each other but for disabled pairs.
//
//   const auto checker = CollisionChecker::make(robot, spheres, &semantics, world, arm.coordinates, rest);
//   if (checker->is_free(q)) ...
//   if (checker->motion_is_free(from, to, 0.02)) ...
//
// A configuration here has a number for each of the coordinates given to make(), in their order; all others
// stay at `rest`. What they do not move is checked against what they move, but neither against the world nor
// itself. What the robot carries (attached_body.h) is checked as its links are. Does not change after it was
// made; any thread.
//
// Works with vectors of the machine's own width (library Highway, chosen when the program runs) in single
// precision. Radii are larger by kRounding_m, which single precision does not come near, and spheres contain
// the bodies (sphere_model.h): a configuration that is called free is free. Steps on the way, cheap ones
// first: obstacles that a link can never reach, the sphere around a link, its spheres; the first collision
// ends a batch.

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/collision/attached_body.h"
#include "supervisor/motion/collision/internal/program.h"
#include "supervisor/motion/collision/world.h"
#include "supervisor/motion/robot/semantics.h"
#include "supervisor/motion/spheres/sphere_model.h"

namespace stepwright::motion {

class CollisionChecker {
 public:
  static constexpr double kRounding_m = 2e-5;

  // `rest` has a value for each coordinate of the robot; without semantics only links that are joined to each
  // other are not checked. Fails with A0301 (check_world) and A0302 (check_attached).
  [[nodiscard]] static result::Result<CollisionChecker> make(const Robot& robot, const SphereModel& spheres,
                                                             const Semantics* semantics, const World& world,
                                                             std::span<const int> coordinates,
                                                             std::span<const double> rest,
                                                             const std::vector<AttachedBody>& attached = {});

  // The same, but these links are not checked with the world: a number for each link, other than 0 for those;
  // what is carried follows the robot's own, in its order, and beyond the end all are checked. Takes
  // microseconds.
  CollisionChecker without_world(std::span<const std::uint8_t> links) const;

  std::size_t columns() const { return program_.columns; }

  // Each requires finite numbers, columns() for a configuration.
  bool is_free(std::span<const double> configuration) const;
  // Configurations one after the other: 1 for each that collides.
  std::vector<std::uint8_t> collisions(std::span<const double> configurations) const;
  // No configuration of them collides.
  bool all_free(std::span<const double> configurations) const;
  // Neither end nor any place between them that is tried, `step` apart at most in each coordinate. Places far
  // from each other are tried together, so that a motion that collides is soon known. No proof for what lies
  // between.
  bool motion_is_free(std::span<const double> from, std::span<const double> to, double step) const;

  const internal::Program& program() const { return program_; }

 private:
  internal::Program program_;
};

}  // namespace stepwright::motion

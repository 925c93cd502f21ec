#pragma once

// Pairs of links whose spheres are in each other in many configurations, though their bodies seldom are:
// links that pass each other closely, which SRDF does not disable. Spheres would refuse much that is free, or
// all. Of such pairs the bodies are asked instead, and of nothing else: that is quick.
//
//   const FalsePairs found = false_pairs(robot, bodies, spheres, &semantics, coordinates, rest);
//   const auto lean = CollisionChecker::make(robot, spheres, &found.for_spheres, ...);
//   const auto pairs = ExactChecker::make(robot, found.bodies, &found.only_pairs, {}, ...);
//
// A function without state; any thread; the same on every machine.

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "supervisor/motion/mesh/link_meshes.h"
#include "supervisor/motion/robot/semantics.h"
#include "supervisor/motion/spheres/sphere_model.h"

namespace stepwright::motion {

struct FalsePairs {
  Semantics for_spheres;                    // as given, and with these pairs disabled
  Semantics only_pairs;                     // all disabled but these pairs
  Bodies bodies;                            // only those of these pairs' links
  std::vector<std::pair<int, int>> pairs;   // links
  std::vector<std::pair<int, int>> always;  // links whose bodies meet in every configuration that was drawn
};

// Draws `count` configurations; a pair counts where spheres overlap in more than `least_share` of them.
// Without semantics links that are joined to each other are disabled.
FalsePairs false_pairs(const Robot& robot, const Bodies& bodies, const SphereModel& spheres,
                       const Semantics* semantics, std::span<const int> coordinates,
                       std::span<const double> rest, std::size_t count = 400, double least_share = 0.02);

}  // namespace stepwright::motion

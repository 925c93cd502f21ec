#pragma once

// A robot as spheres that contain its bodies: what fast checks of collisions look at.
//
//   const auto bodies = read_bodies(robot, meshes);
//   const SphereModel spheres = cover(*bodies, {.protrusion_m = 0.03});
//
// Every point of a body, its inside included, is in a sphere of its link; so a configuration whose spheres
// touch nothing touches nothing. Bodies that are spheres stay as they are. Functions without state; any
// thread.

#include <cstddef>
#include <span>
#include <vector>

#include "supervisor/motion/mesh/link_meshes.h"
#include "supervisor/motion/spheres/enclosing_sphere.h"

namespace stepwright::motion {

struct CoverOptions {
  double protrusion_m = 0.025;     // that spheres may stand out of a body; less makes more spheres
  std::size_t most_per_body = 32;  // where that is not enough, they stand out further
};

struct LinkSpheres {
  Sphere bound;                 // around all of them; radius 0: there are none
  std::vector<Sphere> spheres;  // in the link's frame; those of a group one after the other
};

// Checks look at groups of so many spheres before they look at each: neighbours are to be together.
inline constexpr std::size_t kSpheresTogether = 8;
// In an order in which each group from the first one on is of neighbours. The same on every machine.
void put_neighbours_together(std::span<Sphere> spheres);

struct SphereModel {
  std::vector<LinkSpheres> links;  // one for each link of the robot

  std::size_t count() const {
    std::size_t all = 0;
    for (const LinkSpheres& each : links) all += each.spheres.size();
    return all;
  }
};

SphereModel cover(const Bodies& bodies, const CoverOptions& options = {});
// Spheres around a closed body, in its own frame.
std::vector<Sphere> cover(const TriangleMesh& body, const CoverOptions& options);

// A sphere around spheres. Requires one.
Sphere bound_of(const std::vector<Sphere>& spheres);

// The triangles of a body, in its link's frame; of a cylinder a prism that contains it. Requires no sphere.
TriangleMesh surface_of(const Body& body);

}  // namespace stepwright::motion

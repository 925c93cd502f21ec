#pragma once

// FCL (BSD-3-Clause) behind one header: whether two bodies meet, and how far they are from each other.
// Internal to this folder.
//
// What FCL leaves open is added: a mesh is a surface to it, so a body inside of a closed mesh is asked for
// here; of bodies that overlap no depth is asked. A solid does not change after it was made; any thread.

#include <memory>

#include "supervisor/motion/mesh/link_meshes.h"
#include "supervisor/motion/spheres/enclosing_sphere.h"

namespace stepwright::motion::internal {

class SolidGeometry;

class ExactSolid {
 public:
  explicit ExactSolid(const Body& body);

  const Transform& place() const { return place_; }  // in the frame of its link
  const Sphere& around() const { return around_; }   // in the frame of its link

  // Places are of the bodies themselves: of the link, times place().
  friend bool meet(const ExactSolid& a, const Transform& at_a, const ExactSolid& b, const Transform& at_b);
  // Not more than the true distance, by up to 1e-5 m less; 0 where they meet.
  friend double distance_below(const ExactSolid& a, const Transform& at_a, const ExactSolid& b,
                               const Transform& at_b);

 private:
  bool holds(Vector3 point) const;

  std::shared_ptr<const SolidGeometry> geometry_;  // shared by copies: it is large and does not change
  std::shared_ptr<const TriangleMesh> mesh_;       // of a mesh
  Vector3 point_m_;                                // one of its points, in its own frame
  Vector3 low_m_, high_m_;                         // corners of the box around its points, in its own frame
  Transform place_;
  Sphere around_;
};

bool meet(const ExactSolid& a, const Transform& at_a, const ExactSolid& b, const Transform& at_b);
double distance_below(const ExactSolid& a, const Transform& at_a, const ExactSolid& b, const Transform& at_b);

}  // namespace stepwright::motion::internal

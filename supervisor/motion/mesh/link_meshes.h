#pragma once

// The bodies of a robot's links with their meshes read: what spheres are made of and what exact checks look
// at.
//
//   const auto bodies = read_bodies(robot, MeshLocator("robots/panda"));
//   for (const Body& each : (*bodies)[link]) ...
//
// A function without state; any thread. A file that several links name is read once.

#include <memory>
#include <vector>

#include "supervisor/motion/mesh/triangle_mesh.h"
#include "supervisor/motion/robot/mesh_locator.h"
#include "supervisor/motion/robot/robot.h"

namespace stepwright::motion {

struct Body {
  Shape shape;
  // Of shapes that are meshes, in the frame of the shape; shared because links share files.
  std::shared_ptr<const TriangleMesh> mesh;
};

// For each link its bodies.
using Bodies = std::vector<std::vector<Body>>;

// Fails with A0110 and A0201, for all meshes at once.
[[nodiscard]] result::Result<Bodies> read_bodies(const Robot& robot, const MeshLocator& meshes);
// Where the file of a mesh is not found, the link has the bodies of the link of its name in `instead`,
// another description of the same robot, if these are no meshes; `noted` gets a warning A0112 for each such
// link.
[[nodiscard]] result::Result<Bodies> read_bodies(const Robot& robot, const MeshLocator& meshes,
                                                 const Robot& instead, result::Diagnostics& noted);

}  // namespace stepwright::motion

#pragma once

// Meshes in YAML: triangles and points in the file, or the name of a file of their own. Internal to this
// folder.

#include "supervisor/motion/mesh/triangle_mesh.h"
#include "supervisor/motion/moveit/internal/yaml_reader.h"
#include "supervisor/motion/robot/mesh_locator.h"

namespace stepwright::motion::internal {

struct YamlMesh {
  TriangleMesh mesh;          // without triangles where something is wrong, which was said
  result::Diagnostics wrong;  // of a file of its own
};

// `id` is the object's name. Without `meshes` files of their own are refused.
YamlMesh read_yaml_mesh(YamlReader& reader, const YAML::Node& node, const std::string& id,
                        const MeshLocator* meshes);

}  // namespace stepwright::motion::internal

#include "supervisor/motion/mesh/link_meshes.h"

#include <map>
#include <tuple>

#include "supervisor/motion/mesh/mesh_reader.h"

namespace stepwright::motion {

result::Result<Bodies> read_bodies(const Robot& robot, const MeshLocator& meshes) {
  Bodies bodies(robot.links.size());
  result::Diagnostics wrong;
  std::map<std::tuple<std::string, double, double, double>, std::shared_ptr<const TriangleMesh>> read;
  for (std::size_t k = 0; k < robot.links.size(); ++k)
    for (const Shape& shape : robot.links[k].shapes) {
      Body body{shape, nullptr};
      if (shape.kind == ShapeKind::Mesh) {
        auto& known = read[{shape.mesh, shape.scale.x, shape.scale.y, shape.scale.z}];
        if (!known) {
          const auto file = meshes.find(shape.mesh);
          auto mesh = file ? read_mesh(*file, shape.scale)
                           : result::Result<TriangleMesh>(tl::unexpected(file.error()));
          if (!mesh) {
            wrong.insert(wrong.end(), mesh.error().begin(), mesh.error().end());
            known = std::make_shared<const TriangleMesh>();
          } else {
            known = std::make_shared<const TriangleMesh>(std::move(*mesh));
          }
        }
        body.mesh = known;
      }
      bodies[k].push_back(std::move(body));
    }
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  return bodies;
}

}  // namespace stepwright::motion

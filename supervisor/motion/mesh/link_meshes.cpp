#include "supervisor/motion/mesh/link_meshes.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "supervisor/motion/mesh/mesh_reader.h"
#include "supervisor/motion/robot/codes.h"

namespace stepwright::motion {

namespace {

class BodyReader {
 public:
  BodyReader(const MeshLocator& meshes, const Robot* instead, result::Diagnostics* noted)
      : meshes_(meshes), instead_(instead), noted_(noted) {}

  result::Result<Bodies> read(const Robot& robot) {
    Bodies bodies;
    for (const Link& link : robot.links) bodies.push_back(bodies_of(link));
    if (!wrong_.empty()) return tl::unexpected(std::move(wrong_));
    return bodies;
  }

 private:
  // What is wrong with a file is told once, for the first link that names it.
  struct Known {
    std::shared_ptr<const TriangleMesh> mesh;
    bool missing = false;
  };

  std::vector<Body> bodies_of(const Link& link) {
    std::vector<Body> bodies;
    for (const Shape& shape : link.shapes) {
      Body body{shape, nullptr};
      if (shape.kind == ShapeKind::Mesh) {
        const Known known = read_mesh_of(shape, link.name);
        if (known.missing) return stand_ins(link.name);
        body.mesh = known.mesh;
      }
      bodies.push_back(std::move(body));
    }
    return bodies;
  }

  const Link* instead_of(const std::string& link) const {
    const int number = instead_ != nullptr ? instead_->link(link) : -1;
    if (number < 0) return nullptr;
    const Link& other = instead_->links[static_cast<std::size_t>(number)];
    const auto is_mesh = [](const Shape& each) { return each.kind == ShapeKind::Mesh; };
    return other.shapes.empty() || std::ranges::any_of(other.shapes, is_mesh) ? nullptr : &other;
  }

  std::vector<Body> stand_ins(const std::string& link) const {
    std::vector<Body> bodies;
    for (const Shape& each : instead_of(link)->shapes) bodies.push_back({each, nullptr});
    return bodies;
  }

  Known read_mesh_of(const Shape& shape, const std::string& link) {
    const auto key = std::tuple(shape.mesh, shape.scale.x, shape.scale.y, shape.scale.z);
    if (const auto known = read_.find(key); known != read_.end()) return known->second;
    const auto file = meshes_.find(shape.mesh);
    if (!file && instead_of(link) != nullptr) {
      noted_->push_back({code::kInstead,
                         result::Severity::Warning,
                         {},
                         "the mesh '" + shape.mesh + "' of link '" + link +
                             "' is not found: " + std::to_string(instead_of(link)->shapes.size()) +
                             " bodies of the other description stand for it",
                         {}});
      return {nullptr, true};
    }
    auto mesh = file ? read_mesh(*file, shape.scale) : missing(file.error(), shape, link);
    if (!mesh) wrong_.insert(wrong_.end(), mesh.error().begin(), mesh.error().end());
    const Known known{std::make_shared<const TriangleMesh>(mesh ? std::move(*mesh) : TriangleMesh{}), false};
    read_.emplace(key, known);
    return known;
  }

  // At the place where the robot's file names it.
  static result::Result<TriangleMesh> missing(result::Diagnostics wrong, const Shape& shape,
                                              const std::string& link) {
    for (result::Diagnostic& each : wrong) {
      each.message = "the mesh '" + shape.mesh + "' of link '" + link + "' is not found";
      if (!shape.where.file.empty()) each.where = shape.where;
    }
    return tl::unexpected(std::move(wrong));
  }

  const MeshLocator& meshes_;
  const Robot* instead_;
  result::Diagnostics* noted_;
  std::map<std::tuple<std::string, double, double, double>, Known> read_;
  result::Diagnostics wrong_;
};

}  // namespace

result::Result<Bodies> read_bodies(const Robot& robot, const MeshLocator& meshes) {
  return BodyReader(meshes, nullptr, nullptr).read(robot);
}

result::Result<Bodies> read_bodies(const Robot& robot, const MeshLocator& meshes, const Robot& instead,
                                   result::Diagnostics& noted) {
  return BodyReader(meshes, &instead, &noted).read(robot);
}

}  // namespace stepwright::motion

#include "supervisor/motion/moveit/internal/yaml_mesh.h"

#include <optional>
#include <utility>

#include "supervisor/motion/mesh/mesh_reader.h"
#include "supervisor/motion/moveit/moveit_scene.h"

namespace stepwright::motion::internal {

namespace {

// [x, y, z], or {x, y, z} as messages are written.
std::optional<Vector3> point_of(YamlReader& reader, const YAML::Node& node) {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  const auto numbers = reader.numbers(node, "vertices", kAxes);
  if (numbers.empty()) return std::nullopt;
  return Vector3{numbers[0], numbers[1], numbers[2]};
}

std::optional<std::array<std::uint32_t, 3>> triangle_of(YamlReader& reader, const YAML::Node& node,
                                                        std::size_t points) {
  const auto numbers =
      reader.numbers(node.IsMap() ? reader.member(node, "vertex_indices", true) : node, "vertex_indices", 3);
  if (numbers.empty()) return std::nullopt;
  std::array<std::uint32_t, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(numbers[k] >= 0.0 && numbers[k] < static_cast<double>(points))) {
      reader.complain(code::kBadSceneMember, node, "a triangle names a point that is not there");
      return std::nullopt;
    }
    corners[k] = static_cast<std::uint32_t>(numbers[k]);
  }
  return corners;
}

TriangleMesh mesh_in_file(YamlReader& reader, const YAML::Node& node, const std::string& id) {
  TriangleMesh mesh;
  for (const YAML::Node& each : reader.items(reader.member(node, "vertices", true), "vertices")) {
    const auto point = point_of(reader, each);
    if (!point) return {};
    mesh.points.push_back(*point);
  }
  for (const YAML::Node& each : reader.items(reader.member(node, "triangles", true), "triangles")) {
    const auto corners = triangle_of(reader, each, mesh.points.size());
    if (!corners) return {};
    const auto& c = *corners;
    if (area_m2({mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]}) > 0.0) mesh.triangles.push_back(c);
  }
  if (mesh.triangles.empty())
    reader.complain(code::kBadSceneMember, node, "a mesh of '" + id + "' has no triangle with an area");
  turn_outwards(mesh);
  return mesh;
}

}  // namespace

YamlMesh read_yaml_mesh(YamlReader& reader, const YAML::Node& node, const std::string& id,
                        const MeshLocator* meshes) {
  const YAML::Node resource = reader.member(node, "resource", false);
  if (resource.IsNull()) return {mesh_in_file(reader, node, id), {}};
  if (!resource.IsScalar() || meshes == nullptr) {
    reader.complain(code::kNotRead, node,
                    "a mesh of '" + id + "' is a file of its own, which is not read here");
    return {};
  }
  Vector3 scale{1, 1, 1};
  if (const YAML::Node given = reader.member(node, "dimensions", false); !given.IsNull()) {
    const auto numbers = reader.numbers(given, "dimensions", 3);
    if (numbers.empty()) return {};
    scale = {numbers[0], numbers[1], numbers[2]};
  }
  const auto file = meshes->find(resource.Scalar());
  auto mesh = file ? read_mesh(*file, scale) : result::Result<TriangleMesh>(tl::unexpected(file.error()));
  if (!mesh) {
    for (result::Diagnostic& each : mesh.error())
      if (each.where.file.empty()) each.where = reader.place(node);
    return {{}, std::move(mesh.error())};
  }
  return {std::move(*mesh), {}};
}

}  // namespace stepwright::motion::internal

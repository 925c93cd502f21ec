#include "supervisor/motion/moveit/moveit_scene.h"

#include <algorithm>
#include <utility>

#include "runtime/ground/result/closest.h"
#include "supervisor/motion/moveit/internal/yaml_mesh.h"
#include "supervisor/motion/moveit/internal/yaml_reader.h"

namespace stepwright::motion {

namespace {

class SceneReader {
 public:
  SceneReader(std::string name, const MeshLocator* meshes) : reader_(std::move(name)), meshes_(meshes) {}

  result::Result<MoveItScene> read(std::string_view text) {
    const bool sound = reader_.read(text, [&](const YAML::Node& root) {
      const YAML::Node world = reader_.member(root, "world", true);
      if (!world.IsNull()) read_world(world);
      read_state(reader_.member(root, "robot_state", false));
      read_matrix(reader_.member(root, "allowed_collision_matrix", false));
    });
    result::Diagnostics wrong = reader_.take();
    wrong.insert(wrong.end(), of_files_.begin(), of_files_.end());
    if (!sound || !wrong.empty()) return tl::unexpected(std::move(wrong));
    return std::move(scene_);
  }

 private:
  bool has_some(const YAML::Node& in, const char* name) {
    const YAML::Node list = reader_.member(in, name, false);
    return !list.IsNull() && list.size() > 0;
  }

  void read_world(const YAML::Node& world) {
    if (has_some(reader_.member(world, "octomap", false), "data"))
      reader_.complain(code::kNotRead, world, "the world has an octomap, which is not read");
    for (const YAML::Node& object :
         reader_.items(reader_.member(world, "collision_objects", false), "collision_objects"))
      read_object(object, scene_.world.obstacles);
  }

  void read_object(const YAML::Node& object, std::vector<Obstacle>& into) {
    const std::string id = reader_.text(object, "id");
    for (const char* other : {"planes", "plane_poses"})
      if (has_some(object, other))
        reader_.complain(code::kNotRead, object,
                         "the object '" + id + "' has " + other + ", which are not read",
                         "make it of boxes, cylinders, spheres and meshes");
    const Transform of_object = reader_.pose(reader_.member(object, "pose", false));
    for (const auto& [solid, place] : placed(object, id, "primitives", "primitive_poses"))
      read_solid(id, solid, of_object * place, into);
    for (const auto& [given, place] : placed(object, id, "meshes", "mesh_poses"))
      read_mesh_of(id, given, of_object * place, into);
  }

  // Items of a list with the poses of another one.
  std::vector<std::pair<YAML::Node, Transform>> placed(const YAML::Node& object, const std::string& id,
                                                       const char* list, const char* poses_list) {
    const auto items = reader_.items(reader_.member(object, list, false), list);
    const auto poses = reader_.items(reader_.member(object, poses_list, false), poses_list);
    std::vector<std::pair<YAML::Node, Transform>> all;
    if (items.size() != poses.size())
      reader_.complain(code::kBadSceneMember, object,
                       "the object '" + id + "' has " + std::to_string(items.size()) + " " + list + " and " +
                           std::to_string(poses.size()) + " poses of them");
    else
      for (std::size_t k = 0; k < items.size(); ++k) all.emplace_back(items[k], reader_.pose(poses[k]));
    return all;
  }

  bool too_many(const YAML::Node& at, const std::vector<Obstacle>& into) {
    if (into.size() < kMostObstacles) return false;
    reader_.complain(code::kBadYaml, at, "there are more than 4096 primitives");
    return true;
  }

  void read_mesh_of(const std::string& id, const YAML::Node& given, const Transform& place,
                    std::vector<Obstacle>& into) {
    if (too_many(given, into)) return;
    if (++meshes_read_ > kMostMeshes) {
      reader_.complain(code::kBadYaml, given, "there are more than 256 meshes");
      return;
    }
    auto found = internal::read_yaml_mesh(reader_, given, id, meshes_);
    if (!found.wrong.empty()) of_files_.insert(of_files_.end(), found.wrong.begin(), found.wrong.end());
    if (!found.mesh.triangles.empty())
      into.push_back(mesh(id, place, std::make_shared<const TriangleMesh>(std::move(found.mesh))));
  }

  void read_solid(const std::string& id, const YAML::Node& solid, const Transform& place,
                  std::vector<Obstacle>& into) {
    if (too_many(solid, into)) return;
    // By name, or by the number that shape_msgs/SolidPrimitive has for it.
    const std::string type = reader_.text(solid, "type");
    const YAML::Node given = reader_.member(solid, "dimensions", true);
    if (type.empty() || given.IsNull()) return;
    const bool is_box = type == "box" || type == "1", is_sphere = type == "sphere" || type == "2",
               is_cylinder = type == "cylinder" || type == "3";
    if (!is_box && !is_sphere && !is_cylinder) {
      reader_.complain(code::kNotRead, solid, "primitives of type '" + type + "' are not read",
                       "box, cylinder, sphere");
      return;
    }
    const auto sizes = reader_.numbers(given, "dimensions", is_box ? 3 : is_cylinder ? 2 : 1);
    if (sizes.empty()) return;
    if (*std::min_element(sizes.begin(), sizes.end()) <= 0.0) {
      reader_.complain(code::kBadSceneMember, given, "'dimensions' of '" + id + "' are not above zero");
      return;
    }
    into.push_back(is_box        ? box(id, place, {sizes[0], sizes[1], sizes[2]})
                   : is_cylinder ? cylinder(id, place, sizes[1], sizes[0])  // height, radius
                                 : sphere(id, place.position_m, sizes[0]));
  }

  void read_state(const YAML::Node& state) {
    if (state.IsNull()) return;
    const char* const name = "attached_collision_objects";
    for (const YAML::Node& each : reader_.items(reader_.member(state, name, false), name)) {
      MoveItScene::Hanging hanging;
      hanging.where = reader_.place(each);
      hanging.link = reader_.text(each, "link_name");
      const YAML::Node object = reader_.member(each, "object", true);
      if (object.IsNull()) continue;
      read_object(object, hanging.solids);
      for (const YAML::Node& link : reader_.items(reader_.member(each, "touch_links", false), "touch_links"))
        hanging.touching.push_back(link.IsScalar() ? link.Scalar() : "");
      if (hanging.solids.empty())
        reader_.complain(code::kBadSceneMember, object, "an object that hangs on the robot has no body");
      scene_.hanging.push_back(std::move(hanging));
    }
  }

  void read_matrix(const YAML::Node& matrix) {
    if (matrix.IsNull()) return;
    std::vector<std::string> names;
    for (const YAML::Node& each : reader_.items(reader_.member(matrix, "entry_names", false), "entry_names"))
      names.push_back(each.IsScalar() ? each.Scalar() : "");
    const auto rows = reader_.items(reader_.member(matrix, "entry_values", false), "entry_values");
    if (rows.size() != names.size() || rows.size() > kMostObstacles) {
      reader_.complain(code::kBadSceneMember, matrix, "the collision matrix has not one row for each name");
      return;
    }
    for (std::size_t a = 0; a < rows.size(); ++a) {
      // MoveIt writes a row as a list, or as {enabled: [...]}.
      const YAML::Node list = rows[a].IsMap() ? reader_.member(rows[a], "enabled", true) : rows[a];
      const auto values = reader_.items(list, "entry_values");
      for (std::size_t b = 0; b < std::min(values.size(), a); ++b) {
        bool allowed = false;
        if (values[b].IsScalar() && YAML::convert<bool>::decode(values[b], allowed) && allowed)
          scene_.allowed.emplace_back(names[b], names[a]);
      }
    }
  }

  internal::YamlReader reader_;
  const MeshLocator* meshes_;
  result::Diagnostics of_files_;  // of meshes that are files of their own
  std::size_t meshes_read_ = 0;
  MoveItScene scene_;
};

}  // namespace

result::Result<MoveItScene> read_moveit_scene(std::string_view text, std::string name,
                                              const MeshLocator* meshes) {
  return SceneReader(std::move(name), meshes).read(text);
}

result::Result<std::vector<AttachedBody>> attached_to(const Robot& robot, const MoveItScene& scene) {
  std::vector<std::string> names;
  for (const Link& each : robot.links) names.push_back(each.name);
  std::vector<AttachedBody> all;
  for (const MoveItScene::Hanging& each : scene.hanging) {
    std::vector<int> links;
    for (const std::string& name : each.touching) links.push_back(robot.link(name));
    links.push_back(robot.link(each.link));
    for (std::size_t k = 0; k < links.size(); ++k) {
      if (links[k] >= 0) continue;
      const std::string& name = k < each.touching.size() ? each.touching[k] : each.link;
      const std::string* meant = result::closest(name, names, 2);
      return result::fail(code::kNotOfRobot, each.where, "the robot has no link '" + name + "'",
                          meant ? "did you mean '" + *meant + "'?" : "");
    }
    const int link = links.back();
    links.pop_back();
    std::vector<Body> bodies;
    for (const Obstacle& solid : each.solids) bodies.push_back({solid.shape, solid.mesh});
    all.push_back(attach(each.solids.front().name, link, std::move(bodies), std::move(links)));
  }
  return all;
}

void allow_pairs(const Robot& robot, MoveItScene& scene, Semantics& semantics) {
  for (const auto& [a, b] : scene.allowed) {
    const int first = robot.link(a), second = robot.link(b);
    if (first >= 0 && second >= 0)
      semantics.disabled.emplace_back(std::min(first, second), std::max(first, second));
    else
      scene.world.allowed.emplace_back(a, b);
  }
  std::sort(semantics.disabled.begin(), semantics.disabled.end());
}

}  // namespace stepwright::motion

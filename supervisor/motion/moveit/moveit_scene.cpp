#include "supervisor/motion/moveit/moveit_scene.h"

#include <algorithm>

#include "supervisor/motion/moveit/internal/yaml_reader.h"

namespace stepwright::motion {

namespace {

class SceneReader {
 public:
  explicit SceneReader(std::string name) : reader_(std::move(name)) {}

  result::Result<MoveItScene> read(std::string_view text) {
    const bool sound = reader_.read(text, [&](const YAML::Node& root) {
      const YAML::Node world = reader_.member(root, "world", true);
      if (!world.IsNull()) read_world(world);
      read_state(reader_.member(root, "robot_state", false));
      read_matrix(reader_.member(root, "allowed_collision_matrix", false));
    });
    if (!sound) return tl::unexpected(reader_.take());
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
      read_object(object);
  }

  void read_object(const YAML::Node& object) {
    const std::string id = reader_.text(object, "id");
    for (const char* other : {"meshes", "planes", "mesh_poses", "plane_poses"})
      if (has_some(object, other))
        reader_.complain(code::kNotRead, object,
                         "the object '" + id + "' has " + other + ", which are not read",
                         "make it of boxes, cylinders and spheres");
    const Transform of_object = reader_.pose(reader_.member(object, "pose", false));
    const auto solids = reader_.items(reader_.member(object, "primitives", false), "primitives");
    const auto poses = reader_.items(reader_.member(object, "primitive_poses", false), "primitive_poses");
    if (solids.size() != poses.size()) {
      reader_.complain(code::kBadSceneMember, object,
                       "the object '" + id + "' has " + std::to_string(solids.size()) + " primitives and " +
                           std::to_string(poses.size()) + " poses of them");
      return;
    }
    for (std::size_t k = 0; k < solids.size(); ++k)
      read_solid(id, solids[k], of_object * reader_.pose(poses[k]));
  }

  void read_solid(const std::string& id, const YAML::Node& solid, const Transform& place) {
    if (scene_.world.obstacles.size() == kMostObstacles) {
      reader_.complain(code::kBadYaml, solid, "there are more than 4096 primitives");
      return;
    }
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
    scene_.world.obstacles.push_back(is_box ? box(id, place, {sizes[0], sizes[1], sizes[2]})
                                     : is_cylinder
                                         ? cylinder(id, place, sizes[1], sizes[0])  // height, radius
                                         : sphere(id, place.position_m, sizes[0]));
  }

  void read_state(const YAML::Node& state) {
    if (!state.IsNull() && has_some(state, "attached_collision_objects"))
      reader_.complain(code::kNotRead, state, "an object hangs on the robot, which is not read");
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
  MoveItScene scene_;
};

}  // namespace

result::Result<MoveItScene> read_moveit_scene(std::string_view text, std::string name) {
  return SceneReader(std::move(name)).read(text);
}

}  // namespace stepwright::motion

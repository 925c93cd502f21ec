#include "supervisor/motion/moveit/moveit_scene.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "runtime/ground/result/closest.h"
#include "supervisor/motion/kinematics/link_frames.h"
#include "supervisor/motion/moveit/internal/yaml_mesh.h"
#include "supervisor/motion/moveit/internal/yaml_reader.h"

namespace stepwright::motion {

namespace {

constexpr const char* kWorldFrame = "world";  // what MoveIt calls the frame of a robot that stands still
constexpr double kFarthestObstacle_m = 50.0;

class SceneReader {
 public:
  SceneReader(std::string name, const MeshLocator* meshes) : reader_(std::move(name)), meshes_(meshes) {}

  result::Result<MoveItScene> read(std::string_view text) {
    const bool sound = reader_.read(text, [&](const YAML::Node& root) {
      const YAML::Node world = reader_.member(root, "world", true);
      read_frames(reader_.member(root, "fixed_frame_transforms", false));
      refuse_sizes(reader_.member(root, "link_padding", false), "link_padding", "padding", 0.0);
      refuse_sizes(reader_.member(root, "link_scale", false), "link_scale", "scale", 1.0);
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
    // An octomap with its pose, or the map alone.
    const YAML::Node octomap = reader_.member(world, "octomap", false);
    if (has_some(octomap, "data") || has_some(reader_.member(octomap, "octomap", false), "data"))
      reader_.complain(code::kNotRead, octomap, "the world has an octomap, which is not read");
    for (const YAML::Node& object :
         reader_.items(reader_.member(world, "collision_objects", false), "collision_objects")) {
      const std::size_t first = scene_.world.obstacles.size();
      read_object(object, scene_.world.obstacles);
      scene_.places.resize(scene_.world.obstacles.size(), reader_.place(object));
      const YAML::Node frame = frame_of(object);
      if (frame.IsNull() || frame.Scalar().empty()) continue;
      scene_.framed.push_back(
          {first, scene_.world.obstacles.size() - first, frame.Scalar(), reader_.place(frame)});
    }
  }

  // Null, or the name of a frame.
  YAML::Node frame_of(const YAML::Node& object) {
    const YAML::Node frame = reader_.member(reader_.member(object, "header", false), "frame_id", false);
    if (frame.IsNull() || frame.IsScalar()) return frame;
    reader_.complain(code::kBadSceneMember, frame, "'frame_id' is no text");
    return {};
  }

  void read_frames(const YAML::Node& list) {
    for (const YAML::Node& each : reader_.items(list, "fixed_frame_transforms")) {
      const Transform place =
          reader_.pose(reader_.member(each, "transform", false), "translation", "rotation");
      scene_.frames.emplace_back(reader_.text(each, "child_frame_id"), place);
    }
  }

  // Links that are to be larger than they are.
  void refuse_sizes(const YAML::Node& list, const char* name, const char* what, double none) {
    for (const YAML::Node& each : reader_.items(list, name)) {
      const auto value = reader_.number(reader_.member(each, what, true), what);
      if (value && *value != none)
        reader_.complain(code::kNotRead, each, std::string("'") + name + "' is not read");
    }
  }

  void refuse_far(const std::string& id, const YAML::Node& at, const Obstacle& obstacle) {
    const Shape& shape = obstacle.shape;
    double far_m = length(shape.origin.position_m);
    for (const double each : {shape.size_m.x, shape.size_m.y, shape.size_m.z, shape.radius_m, shape.length_m})
      far_m = std::max(far_m, each);
    if (obstacle.mesh)
      for (const Vector3& each : obstacle.mesh->points) far_m = std::max(far_m, length(each));
    if (far_m <= kFarthestObstacle_m) return;
    char text[48];
    std::snprintf(text, sizeof text, " has a length or place of %.6g m", far_m);
    reader_.complain(code::kSceneUnits, at, "'" + id + "'" + text + ", beyond 50 m",
                     "millimetres were taken for metres? lengths are in metres");
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
    if (found.mesh.triangles.empty()) return;
    into.push_back(mesh(id, place, std::make_shared<const TriangleMesh>(std::move(found.mesh))));
    refuse_far(id, given, into.back());
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
    refuse_far(id, given, into.back());
  }

  void read_state(const YAML::Node& state) {
    if (state.IsNull()) return;
    for (const auto& [joint, value] : reader_.joint_state(reader_.member(state, "joint_state", false))) {
      const auto number = reader_.number(value, "position");
      if (joint.IsScalar() && number) scene_.state.push_back({joint.Scalar(), *number, reader_.place(joint)});
    }
    const char* const name = "attached_collision_objects";
    for (const YAML::Node& each : reader_.items(reader_.member(state, name, false), name)) {
      MoveItScene::Hanging hanging;
      hanging.where = reader_.place(each);
      hanging.link = reader_.text(each, "link_name");
      const YAML::Node object = reader_.member(each, "object", true);
      if (object.IsNull()) continue;
      read_object(object, hanging.solids);
      const YAML::Node frame = frame_of(object);
      if (!frame.IsNull() && !frame.Scalar().empty() && frame.Scalar() != hanging.link)
        reader_.complain(code::kNotRead, frame, "what hangs on a link is placed in another frame than its",
                         "frame_id: " + hanging.link);
      for (const YAML::Node& link : reader_.items(reader_.member(each, "touch_links", false), "touch_links"))
        hanging.touching.push_back(link.IsScalar() ? link.Scalar() : "");
      if (hanging.solids.empty())
        reader_.complain(code::kBadSceneMember, object, "an object that hangs on the robot has no body");
      scene_.hanging.push_back(std::move(hanging));
    }
  }

  void read_matrix(const YAML::Node& matrix) {
    if (matrix.IsNull()) return;
    const auto defaults =
        reader_.items(reader_.member(matrix, "default_entry_names", false), "default_entry_names");
    const auto values =
        reader_.items(reader_.member(matrix, "default_entry_values", false), "default_entry_values");
    for (std::size_t k = 0; k < std::min(defaults.size(), values.size()); ++k)
      if (defaults[k].IsScalar() && is_true(values[k]))
        scene_.allowed_with_all.push_back(defaults[k].Scalar());
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
      const auto row = reader_.items(list, "entry_values");
      for (std::size_t b = 0; b < std::min(row.size(), a); ++b)
        if (is_true(row[b])) scene_.allowed.emplace_back(names[b], names[a]);
    }
  }

  static bool is_true(const YAML::Node& value) {
    bool is = false;
    return value.IsScalar() && YAML::convert<bool>::decode(value, is) && is;
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

result::Result<void> place_framed(const Robot& robot, std::span<const double> values, MoveItScene& scene) {
  std::vector<Transform> links(robot.links.size());
  LinkFrames(robot).place(values, links);
  for (const MoveItScene::Framed& each : scene.framed) {
    const auto given = std::ranges::find(scene.frames, each.frame, &std::pair<std::string, Transform>::first);
    const int link = robot.link(each.frame);
    if (link < 0 && given == scene.frames.end()) {
      if (each.frame == kWorldFrame) continue;
      std::vector<std::string> names;
      for (const Link& known : robot.links) names.push_back(known.name);
      const std::string* meant = result::closest(each.frame, names, 2);
      return result::fail(
          code::kNotOfRobot, each.where, "there is no frame '" + each.frame + "'",
          meant ? "did you mean '" + *meant + "'?" : "a link, 'world', or one of 'fixed_frame_transforms'");
    }
    const Transform& frame = link >= 0 ? links[static_cast<std::size_t>(link)] : given->second;
    for (std::size_t k = each.first; k < each.first + each.count; ++k) {
      Transform& origin = scene.world.obstacles[k].shape.origin;
      origin = frame * origin;
    }
  }
  return {};
}

void allow_pairs(const Robot& robot, MoveItScene& scene, Semantics& semantics) {
  for (const std::string& one : scene.allowed_with_all) {
    for (const Link& each : robot.links)
      if (each.name != one) scene.allowed.emplace_back(one, each.name);
    if (robot.link(one) < 0) continue;
    for (const Obstacle& each : scene.world.obstacles) scene.allowed.emplace_back(one, each.name);
  }
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

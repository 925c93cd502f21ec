#pragma once

// Scenes of MoveIt as files (moveit_msgs/PlanningScene as YAML): the world, and pairs that may touch.
//
//   const auto scene = read_moveit_scene(text, "scene0001.yaml");
//   if (!scene) std::cerr << to_string(scene.error());        // "scene0001.yaml:34:9: A0402: ..."
//
// A function without state; any thread. Objects of boxes, cylinders and spheres are read; meshes, planes and
// objects that hang on the robot are refused, since a world without them would be another one. Frames and
// states that change nothing are passed over.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/collision/world.h"

namespace stepwright::motion {

namespace code {
inline constexpr const char* kBadYaml = "A0401";  // no YAML, or too large
inline constexpr const char* kBadSceneMember =
    "A0402";                                         // a member is missing, of another kind or out of range
inline constexpr const char* kNotRead = "A0403";     // what MoveIt knows and this does not
inline constexpr const char* kNotOfRobot = "A0404";  // a joint or group that the robot does not have
}  // namespace code

inline constexpr std::size_t kMostYamlBytes = std::size_t{4} << 20U;
inline constexpr std::size_t kMostObstacles = 4096;

struct MoveItScene {
  World world;  // an object of several solids is several obstacles of its name
  std::vector<std::pair<std::string, std::string>>
      allowed;  // names of links or objects, from the collision matrix
};

// `name` is the file for messages. Fails with A0401 to A0403, all that is wrong at once.
[[nodiscard]] result::Result<MoveItScene> read_moveit_scene(std::string_view text, std::string name);

}  // namespace stepwright::motion

#pragma once

// Scenes of MoveIt as files (moveit_msgs/PlanningScene as YAML): the world, what hangs on the robot, and
// pairs that may touch.
//
//   const auto scene = read_moveit_scene(text, "scene0001.yaml");
//   if (!scene) std::cerr << to_string(scene.error());        // "scene0001.yaml:34:9: A0402: ..."
//   const auto attached = attached_to(robot, *scene);
//
// Functions without state; any thread. Objects of boxes, cylinders, spheres and meshes are read, meshes with
// their triangles in the file or as files of their own; planes, octomaps, paddings and scales of links are
// refused, since a world without them would be another one.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/collision/attached_body.h"
#include "supervisor/motion/collision/world.h"

namespace stepwright::motion {

namespace code {
inline constexpr const char* kBadYaml = "A0401";  // no YAML, or too large
inline constexpr const char* kBadSceneMember =
    "A0402";                                         // a member is missing, of another kind or out of range
inline constexpr const char* kNotRead = "A0403";     // what MoveIt knows and this does not
inline constexpr const char* kNotOfRobot = "A0404";  // a joint, link, frame or group that there is not
inline constexpr const char* kNotSaid = "A0405";     // a warning: joints without a start
inline constexpr const char* kSceneUnits = "A0601";  // lengths that no cell has
}  // namespace code

inline constexpr std::size_t kMostYamlBytes = std::size_t{4} << 20U;
inline constexpr std::size_t kMostObstacles = 4096;

inline constexpr std::size_t kMostMeshes = 256;

struct JointValue {
  std::string joint;
  double value = 0.0;
  result::Location where;
};

struct MoveItScene {
  // What hangs on the robot: the object's own places are in the frame of the link.
  struct Hanging {
    std::string link;
    std::vector<Obstacle> solids;
    std::vector<std::string> touching;  // links
    result::Location where;
  };
  // Obstacles that are placed in a frame which is not the root's.
  struct Framed {
    std::size_t first = 0, count = 0;
    std::string frame;
    result::Location where;
  };

  World world;                           // an object of several solids is several obstacles of its name
  std::vector<result::Location> places;  // of each obstacle, in the file
  std::vector<Hanging> hanging;
  std::vector<Framed> framed;
  std::vector<std::pair<std::string, Transform>> frames;  // beside the links, in the root's frame
  std::vector<JointValue> state;                          // of the robot
  std::vector<std::pair<std::string, std::string>>
      allowed;                                // names of links or objects, from the collision matrix
  std::vector<std::string> allowed_with_all;  // likewise
};

// `name` is the file for messages. Fails with A0401 to A0403, all that is wrong at once; of meshes that are
// files, which `meshes` finds, with A0110 and A0201.
[[nodiscard]] result::Result<MoveItScene> read_moveit_scene(std::string_view text, std::string name,
                                                            const MeshLocator* meshes = nullptr);

// Fails with A0404: a link that the robot does not have.
[[nodiscard]] result::Result<std::vector<AttachedBody>> attached_to(const Robot& robot,
                                                                    const MoveItScene& scene);

// Puts obstacles of other frames where they are while joints have these values. Fails with A0404: a frame
// that is neither a link nor one of the scene's.
[[nodiscard]] result::Result<void> place_framed(const Robot& robot, std::span<const double> values,
                                                MoveItScene& scene);

// The collision matrix, where it is to count: pairs of links are disabled as SRDF does it, pairs of a link
// and an object are World::allowed.
void allow_pairs(const Robot& robot, MoveItScene& scene, Semantics& semantics);

}  // namespace stepwright::motion

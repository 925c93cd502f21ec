#pragma once

// File of the surroundings of a robot, for people: boxes, cylinders, spheres and meshes in metres and degrees
// (doc: supervisor/doc/motion.md, Files of scenes).
//
//   const auto scene = load_scene("cell.toml");
//   if (!scene) std::cerr << to_string(scene.error());          // "cell.toml:7:10: A0601: ..."
//
// Functions without state; any thread. All mistakes of a file are told at once. Meshes are files beside it.

#include <filesystem>
#include <string_view>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/collision/world.h"

namespace stepwright::motion {

// Numbers of the codes of scene files, which begin with A.
namespace scene_code {
inline constexpr const char* kUnits = "0601";     // lengths that no cell has
inline constexpr const char* kTwice = "0602";     // the same thing twice at one place
inline constexpr const char* kNoTurn = "0603";    // a turn that is none, or said twice
inline constexpr const char* kOverlap = "A0604";  // a warning: two things that stand in each other
}  // namespace scene_code

inline constexpr double kFarthest_m = 50.0;
inline constexpr std::size_t kMostThings = 4096;

struct SceneFile {
  World world;
  std::vector<result::Location> places;      // of each obstacle
  std::vector<result::Location> allowed_at;  // of each allowed pair
  result::Diagnostics warnings;              // things that stand in each other, with both names
};

// Fails with A0001 to A0006 (what is no TOML, unknown keys, wrong types, missing ones), A0601 to A0603, and
// for meshes A0201.
[[nodiscard]] result::Result<SceneFile> load_scene(const std::filesystem::path& file);
[[nodiscard]] result::Result<SceneFile> read_scene(std::string_view text, std::string name,
                                                   const std::filesystem::path& folder);

// A warning for each two obstacles of different names that are in each other by more than `deeper_than_m`:
// things that stand on others touch them. At most `most` and one that counts the others. Requires the place
// of each obstacle; a warning is at that of the later one.
result::Diagnostics overlaps(const World& world, const std::vector<result::Location>& places,
                             double deeper_than_m = 1e-3, std::size_t most = 20);

}  // namespace stepwright::motion

#pragma once

// Problems of the planner as files: JSON that names a scene, GeoJSON with polygons or a ROS map.yaml with its
// image, and has the train, its start and the task (supervisor/doc/ltl_planner.md).
//
// Functions without state; any thread. The files are not trusted; all that is wrong is said at once.
//
//   auto problem = read_planning_problem(text, "cell/problem.json");
//   if (!problem) print(to_string(problem.error()));

#include <filesystem>
#include <string_view>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/scene/scene.h"

namespace stepwright::ltl {

// L0401: no JSON, or a file that cannot be read; L0402: a member that is missing, unknown or of the wrong
// kind; L0403: a number out of range; L0404: a polygon that is not closed; L0405: a name that is used twice.
// And L0301 of trains, F0101 to F0104 of maps. What outlines are worth is for make_regions() to say, and
// where the train stands for check_start().
[[nodiscard]] result::Result<Problem> read_planning_problem(std::string_view text,
                                                            const std::filesystem::path& file);

// The floor alone: GeoJSON features with the property "kind" (border, obstacle, proposition) and "name".
[[nodiscard]] result::Result<Floor> read_scene(std::string_view text, const std::string& file);

}  // namespace stepwright::ltl

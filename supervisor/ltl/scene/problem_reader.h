#pragma once

// Problems of the planner as files: JSON that names a scene, GeoJSON with polygons or a ROS map.yaml with its
// image, and has the train, its start and the task (supervisor/doc/ltl.md, The planner).
//
// A function without state; any thread. The files are not trusted; all that is wrong is said at once.
//
//   auto problem = read_planning_problem(text, "cell/problem.json");
//   if (!problem) print(to_string(problem.error()));

#include <filesystem>
#include <string_view>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/scene/scene.h"

namespace stepwright::ltl {

// Names of files are relative to the folder of `file`. L0401: no JSON, or a file that cannot be read; L0402:
// a member that is missing, unknown or of the wrong kind; L0403: a number out of range; and those of
// read_scene(), L0301 of trains, F0101 to F0104 of maps. Whether the train fits where it stands is for
// plan_train() to say. `train` has the figures that the problem does not name.
[[nodiscard]] result::Result<Problem> read_planning_problem(std::string_view text,
                                                            const std::filesystem::path& file,
                                                            const TrainModel& train = {});

}  // namespace stepwright::ltl

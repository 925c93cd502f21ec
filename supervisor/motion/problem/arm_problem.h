#pragma once

// A scene and a request for a robot: what stands around it, what it carries, which joints may move, from
// where to where.
//
//   const auto problem = load_problem(*model, "scene0001.yaml", "request0001.yaml");
//
// A value; any thread.

#include <filesystem>
#include <memory>
#include <string>

#include "supervisor/motion/moveit/moveit_request.h"
#include "supervisor/motion/path/path.h"
#include "supervisor/motion/path/plan_path.h"
#include "supervisor/motion/problem/arm_model.h"
#include "supervisor/motion/recheck/false_pairs.h"

namespace stepwright::motion {

struct ArmProblem {
  World world;
  std::vector<AttachedBody> attached;
  std::string group;
  std::vector<int> coordinates;        // of the group
  std::vector<double> rest;            // of all coordinates
  std::optional<Semantics> semantics;  // with the pairs that the scene allows; empty: none were given
  Configuration from, to;
  result::Diagnostics notes;  // warnings

  const Semantics* known_pairs() const { return semantics ? &*semantics : nullptr; }
};

// The scene is a TOML of ours (scene_file.h) by its ending, else one of MoveIt; the request is one of MoveIt.
// Without SRDF the group has the joints that the goal names. Joints that the goal does not name keep their
// value; a joint without ends is brought to its goal the short way round. Ends within `rounded` of a limit
// are brought to it, as requests have few digits. Fails with what the files fail with, and A0404 for a group
// that is not there.
[[nodiscard]] result::Result<ArmProblem> load_problem(const ArmModel& model,
                                                      const std::filesystem::path& scene,
                                                      const std::filesystem::path& request,
                                                      double rounded = 1e-4);

// What of an end lies outside of the limits, in words with the joint's name; empty: nothing.
std::string beyond_limits(const ArmModel& model, const ArmProblem& problem, const Configuration& end);

}  // namespace stepwright::motion

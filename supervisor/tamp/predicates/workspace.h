#pragma once

// What the geometric predicates mean (Karlsson et al. 2012): whether an arm can pick, place or move away with
// a given choice of grasp and place, and the state after it. Both planners ask here, so that they differ by
// what they ask and by nothing else.
//
// A pick or place is: from where the arm is straight up (if it is down at something), a path through the air,
// straight down. The tool hangs down on the straight lines, so there the hand and what it holds are judged
// exactly as upright bodies; the rest of the arm, and paths, by spheres (collision_checker.h).
//
// Thread rule: one owner. The cell outlives it. The same calls in the same order give the same answers.
//
//   Workspace workspace(cell, seed);
//   const auto ways = workspace.ways(state, action, sample);         // all of the arm's, or why there are
//   none if (ways) auto settled = workspace.settle(state, action, sample, ways->front(), true);

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <unordered_map>
#include <vector>

#include "supervisor/motion/path/plan_path.h"
#include "supervisor/tamp/predicates/arm_ways.h"
#include "supervisor/tamp/scene/geometric_state.h"
#include "supervisor/tamp/scene/tamp_plan.h"

namespace stepwright::tamp::predicates {

enum class FailureKind : std::uint8_t {
  NoRoom,      // what is placed would meet others, or not lie on the surface
  HandMeets,   // the hand would meet others
  OutOfReach,  // no values of the joints within the limits
  ArmMeets,    // the rest of the arm would meet something on the straight line
  NoPath,      // none was found within the nodes: no proof
  Impossible,  // the action makes no sense in this state
};

struct Failure {
  FailureKind kind = FailureKind::Impossible;
  std::uint64_t things = 0;  // that are in the way: bit k of thing k; ArmMeets and NoPath do not know
  bool proven() const { return kind != FailureKind::NoPath; }
};
const char* name_of(FailureKind kind);

struct Sample {
  double hand_rad = 0.0;  // of a pick: the hand's angle, seen from the thing
  scene::Pose pose;       // of a place
  friend bool operator==(const Sample&, const Sample&) = default;
};

struct Settled {
  scene::GeometricState after;
  scene::PlannedAction action;
};

struct Counts {
  std::uint64_t configurations = 0;  // that were made
  std::uint64_t failed = 0;          // attempts to make one
  std::uint64_t paths = 0, failed_paths = 0;
};

class Workspace {
 public:
  Workspace(const scene::RobotCell& cell, std::uint64_t seed) : cell_(&cell), seed_(seed) {}

  const scene::RobotCell& cell() const { return *cell_; }
  const Counts& counts() const { return counts_; }
  Counts& counts() { return counts_; }

  // Whether things and hand have room, and all ways of the arm. A move away has one. A failure counts as one
  // failed configuration.
  tl::expected<std::vector<ArmWay>, Failure> ways(const scene::GeometricState& state,
                                                  const scene::ActionSpec& action, const Sample& sample);
  // One of these ways, with the straight line and, if asked for, the path to it. Counts one configuration.
  tl::expected<Settled, Failure> settle(const scene::GeometricState& state, const scene::ActionSpec& action,
                                        const Sample& sample, const ArmWay& way, bool with_path);
  // The motions of what was settled without a path.
  tl::expected<std::vector<scene::Motion>, Failure> connect(const scene::GeometricState& before,
                                                            const Settled& settled);

  // How far the hand stays from furniture and other things at a place of its tool; below zero: it meets them.
  double hand_room(int arm, int thing, const ToolPlace& tool,
                   const std::vector<scene::Upright>& others) const;

  // The checker of an arm's paths, everything else as in the state.
  const motion::CollisionChecker& path_checker(const scene::GeometricState& state, int arm);
  motion::JointSpace joint_space(int arm) const;

 private:
  struct Checkers {
    motion::CollisionChecker with_itself, without_hand, all;
  };
  const Checkers& checkers(const scene::GeometricState& state, int arm);
  tl::unexpected<Failure> fail(FailureKind kind, std::uint64_t things = 0);
  std::uint64_t meeting_thing(const scene::GeometricState& state, int thing, const scene::Pose& pose,
                              bool& furniture) const;
  std::uint64_t meeting_hand(const scene::GeometricState& state, int arm, int thing, const ToolPlace& tool,
                             bool& furniture) const;
  bool line_is_free(const scene::GeometricState& state, int arm, const motion::JointPath& line);
  ToolPlace tool_of(const scene::GeometricState& state, const scene::ActionSpec& action,
                    const Sample& sample) const;
  scene::GeometricState after(const scene::GeometricState& state, const scene::ActionSpec& action,
                              const Sample& sample, motion::JointPath line) const;

  const scene::RobotCell* cell_;
  std::uint64_t seed_;
  Counts counts_;
  std::unordered_map<std::uint64_t, Checkers> checkers_;
};

}  // namespace stepwright::tamp::predicates

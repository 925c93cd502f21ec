#pragma once

// The geometric predicates (Karlsson et al. 2012): whether an arm can pick, place or move away with a given
// choice of grasp and place, and the state after it. Both planners ask here, so that they differ by what they
// ask and by nothing else.
//
// A pick or place is: from where the arm is straight up (if it is down at something), a path through the air
// (transfer.h), straight down. The tool hangs down on the straight lines, so there the hand and what it holds
// are judged exactly as upright bodies; the rest of the arm, and paths, by spheres (collision_checker.h).
//
// Thread rule: one owner. The cell outlives it. The same calls in the same order give the same answers.
//
//   Workspace workspace(cell, seed);
//   const auto ways = workspace.ways(state, action, sample);     // all of the arm's, or why there are none
//   if (ways) auto settled = workspace.settle(state, action, sample, ways->front(), true);

#include <cstdint>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <unordered_map>
#include <vector>

#include "supervisor/motion/path/plan_path.h"
#include "supervisor/tamp/predicates/arm_ways.h"
#include "supervisor/tamp/predicates/failure.h"
#include "supervisor/tamp/scene/geometric_state.h"
#include "supervisor/tamp/scene/tamp_plan.h"

namespace stepwright::tamp::predicates {

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
  std::uint64_t straight_paths = 0, tree_paths = 0;  // of the paths: how they were looked for
  std::uint64_t path_motions = 0;                    // that trees have checked
};

class Workspace {
 public:
  Workspace(const scene::RobotCell& cell, std::uint64_t seed);

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

  // More nodes for each path: what was not found before may be found now.
  void set_path_nodes(std::size_t nodes) { path_nodes_ = nodes; }

  // How far the hand stays from furniture and other things at a place of its tool; below zero: it meets them.
  double hand_room(int arm, int thing, const ToolPlace& tool,
                   const std::vector<scene::Upright>& others) const;

  // The checker of an arm's paths, everything else as in the state.
  const motion::CollisionChecker& path_checker(const scene::GeometricState& state, int arm);
  motion::JointSpace joint_space(int arm) const;

 private:
  // Of paths everything; of straight lines, where hands and what they hold are judged as upright bodies, the
  // rest of the arm with the world and all of it with itself.
  struct Checkers {
    motion::CollisionChecker all, line;
  };
  struct WayKey {
    int arm = 0;
    ToolPlace place;
    friend bool operator==(const WayKey&, const WayKey&) = default;
  };
  struct WayHash {
    std::size_t operator()(const WayKey& key) const;
  };
  const Checkers& checkers(const scene::GeometricState& state, int arm, double half_open_m);
  double half_open_on_the_way(const scene::GeometricState& state, const scene::ActionSpec& action) const;
  const std::vector<ArmWay>& all_ways_of(int arm, const ToolPlace& place);
  tl::unexpected<Failure> fail(const Failure& failure);
  Failure meeting_thing(const scene::GeometricState& state, int thing, const scene::Pose& pose) const;
  std::optional<Failure> refused_place(const scene::GeometricState& state, const scene::ActionSpec& action,
                                       const Sample& sample) const;
  std::uint64_t standing_on(const scene::GeometricState& state, int thing) const;
  Failure meeting_hand(const scene::GeometricState& state, int arm, int thing, const ToolPlace& tool) const;
  bool line_is_free(const scene::GeometricState& state, int arm, double half_open_m,
                    const motion::JointPath& line);
  ToolPlace tool_of(const scene::GeometricState& state, const scene::ActionSpec& action,
                    const Sample& sample) const;
  scene::GeometricState after(const scene::GeometricState& state, const scene::ActionSpec& action,
                              const Sample& sample, motion::JointPath line) const;

  const scene::RobotCell* cell_;
  std::uint64_t seed_;
  Counts counts_;
  std::size_t path_nodes_;
  std::vector<std::vector<std::uint8_t>> hand_links_;  // of each arm: its hand's, and what hands hold
  std::unordered_map<std::uint64_t, Checkers> checkers_;
  std::unordered_map<WayKey, std::vector<ArmWay>, WayHash> ways_;  // whatever stands around
};

}  // namespace stepwright::tamp::predicates

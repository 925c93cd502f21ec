#pragma once

// Ways through the air that keep away from the other arm, which rests meanwhile: a planner's path may pass it
// as closely as bodies allow, and then no interlock can tell it from an accident. Detail of this folder; the
// same seed gives the same path.

#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/motion/blend/blended_path.h"
#include "supervisor/motion/path/path.h"
#include "supervisor/motion/recheck/exact_checker.h"
#include "supervisor/motion/timing/motion_table.h"
#include "supervisor/motion/timing/time_law.h"
#include "supervisor/tamp/scene/geometric_state.h"
#include "supervisor/tamp/schedule/arm_capsules.h"

namespace stepwright::tamp::schedule {

struct ClearOptions {
  double clear_m = 0.09;  // of capsules; less where the path's ends are nearer, or no way is found
  std::uint64_t seed = 1;
};

// The nearest that the arm comes to capsules that rest, at places `kLook_rad` apart along the path.
inline constexpr double kLook_rad = 0.02;
double nearest_of(const ArmCapsules& arm, const motion::JointPath& path, const std::vector<Capsule>& rest);

// The least of it in the scan of an interlock while the arm goes along its motion: where it is, and where it
// would be if each joint braked by itself, less what the next scans may take (MC_WatchDistance).
double room_of(const ArmCapsules& arm, const motion::BlendedPath& path, const motion::TimeLaw& law,
               const motion::StopLimits& stop, const std::vector<Capsule>& rest);

// The path itself if it is clear, or nothing better is found. Every motion of another one was accepted by
// `exact`, which is of the same state and arm.
motion::JointPath kept_clear(const scene::RobotCell& cell, const scene::GeometricState& state,
                             std::size_t arm, const ArmCapsules& capsules, const std::vector<Capsule>& rest,
                             const motion::ExactChecker& exact, const motion::JointPath& path,
                             const ClearOptions& options);

}  // namespace stepwright::tamp::schedule

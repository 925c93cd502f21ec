#pragma once

// Schedule of the arms (what each does one after the other, when, and what it waits for): a plan of tasks and
// motions as motions in time (supervisor/doc/arms_program.md). Values; any thread.
//
//   auto made = schedule_plan(cell, initial_state(cell), plan);       // schedule_plan.h
//   for (const ScheduledStep& each : made->arms[left].steps) ...
//
// How far an arm has come is one number, its progress: steps that it has finished, and of the one that it is
// at the share of its path's time. It never falls. All that an arm waits for is the progress of another one,
// and it is always that of an action earlier in the plan; so nobody waits in a circle, however late arms are.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/motion/blend/blended_path.h"
#include "supervisor/motion/timing/limits.h"
#include "supervisor/motion/timing/motion_table.h"
#include "supervisor/motion/timing/time_law.h"
#include "supervisor/tamp/scene/geometric_state.h"
#include "supervisor/tamp/scene/tamp_plan.h"
#include "supervisor/tamp/schedule/arm_capsules.h"

namespace stepwright::tamp::schedule {

enum class StepKind : std::uint8_t {
  Fingers,   // to another opening, without anything between them
  Approach,  // through the air, empty
  Linear,    // straight up or down, empty
  Grip,      // the fingers close on a thing
  Lift,      // straight up, with it
  Transfer,  // through the air, with it
  Lower,     // straight down, with it
  Release,   // the fingers open
};
const char* name_of(StepKind kind);
constexpr bool moves(StepKind kind) {
  return kind != StepKind::Fingers && kind != StepKind::Grip && kind != StepKind::Release;
}
constexpr bool carries(StepKind kind) {
  return kind == StepKind::Lift || kind == StepKind::Transfer || kind == StepKind::Lower;
}

// A motion from rest to rest, without corners, in time; and the same as data for MC_MovePath.
struct TimedMotion {
  motion::BlendedPath path;
  motion::TimeLaw law;
  motion::MotionTable table;
  double duration_s() const { return law.duration(); }
};

// Before an arm may be farther than `at` in its step (0 to 1 of the path's time; 0: before the step begins),
// the other arm must have come to `progress`.
struct Wait {
  double at = 0.0;
  std::size_t other = 0;  // arm
  double progress = 0.0;
  friend bool operator==(const Wait&, const Wait&) = default;
};

struct ScheduledStep {
  StepKind kind = StepKind::Approach;
  std::size_t action = 0;    // of the plan
  int thing = -1;            // that is held, grasped or let go
  double half_open_m = 0.0;  // half the way between the fingers: during a motion, or at the end of the others
  std::optional<Capsule> held;  // of a grip: the thing in the hand
  std::optional<TimedMotion> motion;
  double duration_s = 0.0;  // as planned, without waiting
  std::vector<Wait> waits;  // `at` and `progress` grow
  // As planned, with everybody in time.
  double start_s = 0.0, finish_s = 0.0;
};

struct ArmSchedule {
  motion::Configuration start;    // where it stands at the beginning
  double half_open_m = 0.0;       // of its fingers then
  int holds = -1;                 // a thing
  std::optional<Capsule> held{};  // that thing
  std::vector<ScheduledStep> steps;
};

struct CellSchedule {
  std::vector<ArmSchedule> arms;  // in the cell's order; without steps: it stands
  double makespan_s = 0.0;        // arms work at the same time
  double sequential_s = 0.0;      // one action after the other
  // The nearest that the arms come to each other in the plan, action after action, where they are and where
  // they would be if they braked there: what MC_WatchDistance looks at. By the capsules of arm_capsules.h
  // with what they hold; infinite with one arm.
  double nearest_m = 0.0;
  motion::JointLimits limits;  // of each arm, as planned
  motion::StopLimits stop;     // while the override changes

  std::size_t steps() const;
  std::size_t waits() const;
  std::size_t most_rows() const;   // of a motion
  std::size_t total_rows() const;  // of all motions
};

}  // namespace stepwright::tamp::schedule

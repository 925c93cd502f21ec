#pragma once

// Context that the parts of a program are written from. Detail of this folder; values.

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/tamp/program/arms_program.h"
#include "supervisor/tamp/schedule/arm_capsules.h"

namespace stepwright::tamp::program {

// The names of a path's three variables.
struct PathNames {
  std::string path, points, rows;
  bool empty() const { return path.empty(); }
};

struct ProgramContext {
  const ArmsProgramInput& input;
  const CellTerminals& terminals;
  const ArmsProgramOptions& options;
  std::vector<std::string> names = {};             // of the arms, as identifiers
  std::vector<std::vector<PathNames>> paths = {};  // by arm and step; empty where nothing moves
  std::vector<schedule::ArmCapsules> bodies = {};  // of each arm, for the interlock; none with one arm
  double min_distance_m = 0.0;

  const scene::RobotCell& cell() const { return *input.cell; }
  std::size_t arms() const { return input.cell->arms.size(); }
  const schedule::ArmSchedule& arm(std::size_t k) const { return input.schedule->arms[k]; }
  bool follows() const { return input.kind == ArmsProgramKind::Follow; }
  bool halts() const { return input.kind == ArmsProgramKind::Halt; }
  bool observes() const { return input.kind == ArmsProgramKind::Observe; }
  bool takes_pictures() const { return observes() || options.camera_every.count() > 0; }
};

// As terminals count: openings and places, angles.
inline int tenths_mm(double metres) {
  return static_cast<int>(std::lround(1e4 * metres));
}
// What fingers are told to hold a thing, and what its width is.
int closing(const ProgramContext& context, int thing);
int width_of(const ProgramContext& context, int thing);

// Statements by which the interlock knows what an arm holds (nothing: its hand is empty); empty with one arm.
std::string held_text(const ProgramContext& context, std::size_t arm,
                      const std::optional<schedule::Capsule>& held);

// A place in a schedule, to the sixth digit.
std::string progress_literal(double progress);

// A wait within a motion that is too near to its begin to stop before it: the motion is not begun.
bool waits_at_start(const schedule::ScheduledStep& step, const schedule::Wait& wait);

}  // namespace stepwright::tamp::program

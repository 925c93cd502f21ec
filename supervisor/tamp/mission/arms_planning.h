#pragma once

// Plans of a cell's arms as programs: from where arms and things are to an order's goal and back home, as a
// container that the runtime runs; the one that brings the arms to rest; the one that only looks.
//
// Threads: any, of an object that does not change. Example:
//   auto planning = ArmsPlanning::open(options);
//   auto prepared = planning->plan({.order = &planning->first_order(), .state = state});
//   controller.download(prepared->container);

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ladder/driver/watcher.h"
#include "runtime/ground/result/result.h"
#include "supervisor/lisp/place.h"
#include "supervisor/tamp/mission/order.h"
#include "supervisor/tamp/mission/sight.h"
#include "supervisor/tamp/program/arms_program.h"
#include "supervisor/tamp/scene/tamp_plan.h"

namespace stepwright::tamp::mission {

// Codes of plan() by which somebody decides.
inline constexpr const char* kNoPlan = "G0404";    // proved
inline constexpr const char* kNotFound = "G0405";  // within the time
inline constexpr const char* kNoWayHome = "G0406";

// Of programs of a mission: five reports of the camera at a look, pictures while the arms work.
program::ArmsProgramOptions program_options();

struct ArmsPlanningOptions {
  scene::RobotCell cell;
  result::Diagnostics warnings{};  // of the cell's file
  lisp::Source domain;             // PDDL, `stacking-arms`
  std::vector<ArmsOrder> orders;   // at least one
  std::vector<int> exchange{};     // regions where things change hands; none: any
  std::size_t first = 0;           // the order that a run begins with
  program::CellTerminals terminals;
  program::ArmsProgramOptions program = program_options();
  std::uint64_t seed = 1;
  double most_s = 60.0;                     // for a machine that is far too slow: what ends is counted work
  std::vector<driver::Watcher> watchers{};  // compiled with every program
};

struct ArmsPlanRequest {
  const ArmsOrder* order = nullptr;
  scene::GeometricState state{};
  std::vector<Seen> strangers{};  // stand on the table as well
  // Of each arm: from where it is along the way that it came, for one that touches something there.
  std::vector<motion::JointPath> back{};
  bool only_looked_at = false;  // no program is made of it
  const std::atomic<bool>* cancel = nullptr;
};

struct ArmsRetreatRequest {
  std::size_t arm = 0;  // that has met something
  scene::GeometricState state{};
  std::vector<Seen> strangers{};
  motion::JointPath back{};  // from where it is along the way that it came
};

struct PreparedArms {
  program::ArmsProgram program;
  std::vector<std::byte> container;
  std::shared_ptr<const scene::RobotCell> cell;  // as it was planned in
  scene::GeometricState start;
  std::vector<Seen> strangers{};  // that were known
  scene::TampPlan plan;
  schedule::CellSchedule schedule;
  bool retreats = false;  // it does nothing for an order
  double spent_ms = 0.0;
};

class ArmsPlanning {
 public:
  // G0402, G0407: what orders cannot say of the cell; those of the domain.
  [[nodiscard]] static result::Result<ArmsPlanning> open(ArmsPlanningOptions options);

  const ArmsPlanningOptions& options() const { return options_; }
  const scene::RobotCell& cell() const { return options_.cell; }
  const ArmsOrder& first_order() const { return options_.orders[options_.first]; }
  // By its name, or a goal in PDDL. Codes of read_order().
  [[nodiscard]] result::Result<ArmsOrder> order(const std::string& text) const;

  // G0404 to G0406, those of schedule_plan() and arms_program().
  [[nodiscard]] result::Result<PreparedArms> plan(const ArmsPlanRequest& request) const;
  // Back along the way that an arm came, until it is clear of what it has met (retreat.h); G0406: it is
  // clear, or cannot go back; those of schedule_plan() and arms_program().
  [[nodiscard]] result::Result<PreparedArms> retreat(const ArmsRetreatRequest& request) const;
  // Along the paths of what is driven, until both arms stand.
  [[nodiscard]] result::Result<PreparedArms> halt(const PreparedArms& driven) const;
  // Nothing moves, brakes on: the camera reports. `reset`: another number each time.
  [[nodiscard]] result::Result<PreparedArms> observe(std::uint32_t reset) const;

 private:
  explicit ArmsPlanning(ArmsPlanningOptions options) : options_(std::move(options)) {}
  scene::RobotCell cell_with(const std::vector<Seen>& strangers, const scene::GeometricState& state) const;
  [[nodiscard]] result::Result<std::vector<scene::PlannedAction>> actions_for(
      const ArmsPlanRequest& request, const scene::RobotCell& cell, const scene::GeometricState& state,
      std::uint64_t seed) const;
  [[nodiscard]] result::Result<void> compile(program::ArmsProgramKind kind, std::uint32_t reset,
                                             PreparedArms& prepared) const;

  ArmsPlanningOptions options_;
};

}  // namespace stepwright::tamp::mission

#include "supervisor/tamp/scene/tamp_plan.h"

namespace stepwright::tamp::scene {

std::string text_of(const RobotCell& cell, const ActionSpec& action) {
  const std::string& arm = cell.arms[static_cast<std::size_t>(action.arm)].name;
  const std::string& thing = cell.things[static_cast<std::size_t>(action.thing)].name;
  switch (action.kind) {
    case ActionKind::Pick:
      return arm + " picks " + thing;
    case ActionKind::Place:
      return arm + " places " + thing + " on " +
             (action.on >= 0 ? cell.things[static_cast<std::size_t>(action.on)].name
                             : cell.surfaces[static_cast<std::size_t>(action.surface)].name);
    case ActionKind::MoveAway:
      return arm + " moves away from " + thing;
  }
  return {};
}

const char* name_of(Phase phase) {
  switch (phase) {
    case Phase::Lift:
      return "lift";
    case Phase::Lower:
      return "lower";
    default:
      return "transfer";
  }
}

}  // namespace stepwright::tamp::scene

#include "programs/supervisor/cell_mission.h"

#include <algorithm>

#include "programs/supervisor/fleet_mission.h"
#include "programs/supervisor/planned_mission.h"

namespace stepwright::supervisor_program {
namespace {

// A planner joins by a line here. The first whose table the cell has attends it.
struct Kind {
  bool (*is_of)(const config::CellConfig& config);
  result::Result<std::unique_ptr<CellMission>> (*open)(const config::CellConfig& config);
};
constexpr Kind kKinds[] = {{has_fleet, open_fleet_mission}, {has_planning, open_planned_mission}};

}  // namespace

result::Result<void> not_of_this_cell(const char* hint) {
  return result::fail("X0003", {}, "this cell does not take such requests", hint);
}

bool CellMission::is_wanted(const config::CellConfig& config) {
  return std::ranges::any_of(kKinds, [&](const Kind& kind) { return kind.is_of(config); });
}

result::Result<std::unique_ptr<CellMission>> CellMission::open(const config::CellConfig& config) {
  return std::ranges::find_if(kKinds, [&](const Kind& kind) { return kind.is_of(config); })->open(config);
}

}  // namespace stepwright::supervisor_program

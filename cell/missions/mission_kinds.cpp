#include "cell/missions/mission_kinds.h"

#include <algorithm>
#include <iterator>

namespace stepwright::missions {

// Each planner's own (cell/missions/NAME).
#define STEPWRIGHT_MISSION(name) \
  result::Result<std::unique_ptr<CellPlanner>> open_##name(const config::CellConfig& config);
#include "cell/missions/missions.def"
#undef STEPWRIGHT_MISSION

namespace {

struct Kind {
  const char* name;
  result::Result<std::unique_ptr<CellPlanner>> (*open)(const config::CellConfig& config);
};

constexpr Kind kKinds[] = {
#define STEPWRIGHT_MISSION(name) {#name, open_##name},
#include "cell/missions/missions.def"
#undef STEPWRIGHT_MISSION
};

}  // namespace

result::Result<std::unique_ptr<CellPlanner>> open(const config::CellConfig& config) {
  return std::ranges::find(kKinds, config.mission.name, &Kind::name)->open(config);
}

}  // namespace stepwright::missions

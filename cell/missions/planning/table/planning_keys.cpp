#include <array>

#include "cell/missions/planning/table/planning_table.h"

namespace stepwright::missions {
namespace {

using settings::KeyWords;

constexpr std::array kPlanningKeys = {
    KeyWords{"planning", "A problem in PDDL, and how it is planned for."},
    KeyWords{"planning.domain", "The domain, PDDL.", "", "", settings::kPathOfFile},
    KeyWords{"planning.problem", "The problem, PDDL.", "", "", settings::kPathOfFile},
    KeyWords{"planning.binding", "What actions and fluents are in the plant (TOML).", "", "",
             settings::kPathOfFile},
    KeyWords{"planning.programs", "Programs written by hand, PLCopen XML, that run behind the plan.", "", "",
             settings::kPathOfFile},
    KeyWords{"planning.dialect", "The dialect of those programs, and of sources that the page brings."},
    KeyWords{"planning.optimal", "The optimum is proved before the start, within `time_ms`."},
    KeyWords{"planning.sequential", "One action at a time."},
    KeyWords{"planning.initial", "Where the first plan starts: as the `problem` says, or as sensors show it.",
             "", "`observed` with real I/O, else `problem`"},
    KeyWords{"planning.monitors",
             "Rungs that watch the plan in the scan; without them a small controller has room."},
    KeyWords{"planning.time_ms", "Budget of one planning."},
};

}  // namespace

std::span<const KeyWords> planning_keys() {
  return kPlanningKeys;
}

}  // namespace stepwright::missions

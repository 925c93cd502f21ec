#include <array>

#include "cell/missions/ltl/table/ltl_table.h"

namespace stepwright::missions {
namespace {

using settings::KeyWords;

constexpr std::array kLtlKeys = {
    KeyWords{"ltl", "A tugger train whose task is a formula of temporal logic."},
    KeyWords{"ltl.problem", "Floor, train, start and task (JSON).", "", "", settings::kPathOfFile},
    KeyWords{"ltl.task", "The task, in place of the problem's.", "", "the problem's"},
    KeyWords{"ltl.margin_m", "Kept around each link, for what driving deviates."},
    KeyWords{"ltl.top_speed_m_s", "Planned speed."},
    KeyWords{"ltl.time_s", "Wall time until there is a plan."},
    KeyWords{"ltl.seed", "The same seed has the same plan, unless the time was over."},
    KeyWords{"ltl.threads", "Of the planner; 0: as many as the machine has.", "threads"},
    KeyWords{"ltl.hold_s", "So long the train waits for somebody."},
    KeyWords{"ltl.attended", "Somebody can see to what the train cannot do; `false`: then the run ends."},
    KeyWords{"ltl.requests", "An operator asks for this at that time."},
    KeyWords{"ltl.requests.at_s", "Plant time."},
    KeyWords{"ltl.requests.request", "What is asked for.", "", "",
             "`goal`, `block`, `unblock`, `hold` or `resume`"},
    KeyWords{"ltl.requests.goal", "The new task, of `goal`.", "", "none"},
    KeyWords{"ltl.requests.name", "A place of the floor, of `block` and `unblock`.", "", "none"},
};

}  // namespace

std::span<const KeyWords> ltl_keys() {
  return kLtlKeys;
}

}  // namespace stepwright::missions

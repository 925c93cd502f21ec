#include <array>

#include "cell/missions/tamp/table/tamp_table.h"

namespace stepwright::missions {
namespace {

using settings::KeyWords;

constexpr std::array kTampKeys = {
    KeyWords{"tamp", "A robot cell: tasks and motions planned together."},
    KeyWords{"tamp.problem", "Arms, furniture, regions, things (TOML).", "", "", settings::kPathOfFile},
    KeyWords{"tamp.domain", "The domain of orders, PDDL.", "", "the problem's own", settings::kPathOfFile},
    KeyWords{"tamp.order", "The first order: its name, or a goal.", "", "the first of the list"},
    KeyWords{"tamp.exchange", "Regions where things change hands.", "", "any"},
    KeyWords{"tamp.time_s", "Wall time until there is a plan."},
    KeyWords{"tamp.seed", "The same seed has the same plan, unless the time was over."},
    KeyWords{"tamp.retries", "Of one thing that slips, is missed or was moved.", "tries"},
    KeyWords{"tamp.following_rad",
             "A joint farther from its set point, besides what it moves between two scans, has failed: its "
             "arm brakes."},
    KeyWords{"tamp.pictures_ms", "Between pictures of the camera while the arms work."},
    KeyWords{"tamp.hold_s", "So long the arms wait for somebody."},
    KeyWords{"tamp.attended", "Somebody can see to what the arms cannot do; `false`: then the run ends."},
    KeyWords{"tamp.orders", "What can be asked for, by name; at least one."},
    KeyWords{"tamp.orders.name", "Its name."},
    KeyWords{"tamp.orders.goal", "The goal, as `(in cup1 red-region)`."},
    KeyWords{"tamp.requests", "An operator asks for this at that time."},
    KeyWords{"tamp.requests.at_s", "Plant time."},
    KeyWords{"tamp.requests.request", "What is asked for.", "", "", "`goal`, `hold` or `resume`"},
    KeyWords{"tamp.requests.goal", "The name of an order, or a goal.", "", "none"},
};

}  // namespace

std::span<const KeyWords> tamp_keys() {
  return kTampKeys;
}

}  // namespace stepwright::missions

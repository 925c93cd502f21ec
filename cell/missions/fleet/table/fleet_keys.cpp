#include <array>

#include "cell/missions/fleet/table/fleet_table.h"

namespace stepwright::missions {
namespace {

using settings::KeyWords;

constexpr std::array kFleetKeys = {
    KeyWords{"fleet", "Vehicles on a floor: loads, paths, who goes first."},
    KeyWords{"fleet.problem", "Floor, vehicles and goals (JSON).", "", "", settings::kPathOfFile},
    KeyWords{"fleet.path_factor", "Paths are proved to cost at most so many times the least.", "1"},
    KeyWords{"fleet.time_ms", "Budget of a planning; 0: none, so that plans are the same on every machine."},
    KeyWords{"fleet.late_ms", "Who is later than scheduled by more gives all others new times."},
    KeyWords{"fleet.hold_s", "So long an emergency stop holds the fleet until somebody lets it go on."},
    KeyWords{"fleet.attended", "Somebody can see to what the fleet cannot do; `false`: then the run ends."},
    KeyWords{"fleet.requests", "An operator asks for this at that time."},
    KeyWords{"fleet.requests.at_s", "Plant time."},
    KeyWords{"fleet.requests.request", "What is asked for.", "", "", "`return`, `hold` or `resume`"},
    KeyWords{"fleet.requests.vehicle", "The one that is to `return`.", "", "none"},
    KeyWords{"fleet.orders", "A load that somebody orders at that time."},
    KeyWords{"fleet.orders.at_s", "Plant time."},
    KeyWords{"fleet.orders.name", "Name of the order."},
    KeyWords{"fleet.orders.from", "Where the load is."},
    KeyWords{"fleet.orders.to", "Where it is to be."},
    KeyWords{"fleet.orders.amount", "How many loads.", "loads"},
};

}  // namespace

std::span<const KeyWords> fleet_keys() {
  return kFleetKeys;
}

}  // namespace stepwright::missions

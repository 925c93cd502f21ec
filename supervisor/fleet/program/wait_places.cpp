#include "supervisor/fleet/program/wait_places.h"

#include <algorithm>

namespace stepwright::fleet {
namespace {

// How near a vehicle surely comes to where it halts.
constexpr double kReached_m = 0.1;

}  // namespace

WaitPlaces wait_places(const VehicleMission& mission, const FleetMargins& margins) {
  const auto& visits = mission.grown.visits;
  WaitPlaces places;
  for (const Visit& visit : visits) places.halt_m.push_back(visit.entry_m - margins.halt_before_m);
  const auto& halt = places.halt_m;
  for (std::size_t k = 0; k < visits.size(); ++k) {
    double at = visits[k].exit_m + margins.left_behind_m;
    if (k + 2 < visits.size()) at = std::min(at, halt[k + 2] - kReached_m);
    if (k + 1 < visits.size()) at = std::max(at, visits[k + 1].entry_m + margins.left_behind_m);
    places.free_m.push_back(at);
  }
  std::size_t in = 0;
  for (const Stop& stop : mission.stops) {
    while (in + 1 < visits.size() && halt[in + 1] <= stop.arc_m) ++in;
    places.stops_in.push_back(in);
  }
  for (std::size_t k = 0; k < visits.size(); ++k) {
    const double free_m = places.free_m[k];
    std::size_t into = std::min(k + 1, visits.size() - 1);
    // Before these it would halt short of that place, or it stops there first.
    while (into + 1 < visits.size() && halt[into + 1] < free_m + 0.5 * kReached_m) ++into;
    for (std::size_t stop = 0; stop < mission.stops.size(); ++stop) {
      if (free_m > mission.stops[stop].arc_m) into = std::max(into, places.stops_in[stop]);
    }
    places.left_into.push_back(into);
  }
  return places;
}

}  // namespace stepwright::fleet

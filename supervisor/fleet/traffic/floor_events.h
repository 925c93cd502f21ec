#pragma once

// What happens on the floor while vehicles drive: places that are blocked, vehicles that die and come back.
// Keeps traffic and route planner in step, and says what became of every vehicle concerned.
//
// One thread at a time; both must outlive it. A vehicle whose way leads through a blocked place may at once
// go no farther than to there; then it is planned anew from where it can stop. Who finds no way goes home;
// who finds none there either, or for whom there is no schedule, waits.
//
//   FloorEvents events(traffic, planner);
//   const auto blocked = events.block(area, now);
//   for (const Detour& detour : blocked.detours) report(detour);
//   ...
//   for (const Detour& detour : events.unblock(blocked.number)) report(detour);

#include <chrono>
#include <cstdint>
#include <map>
#include <vector>

#include "supervisor/fleet/traffic/route_planner.h"
#include "supervisor/fleet/traffic/traffic.h"

namespace stepwright::fleet {

enum class DetourKind : std::uint8_t {
  Rerouted,  // through all of its stops another way
  SentHome,  // its stops cannot be reached: they are given up
  Waits,     // before the place, until it is free
  DrivesOn,  // waited, and need not any more
};

struct Detour {
  std::uint32_t vehicle = 0;
  DetourKind kind = DetourKind::Waits;
  std::vector<Stop> given_up;
  result::Diagnostics why;  // Waits and SentHome
};

struct Blockage {
  std::uint32_t number = 0;
  std::vector<Detour> detours;
};

class FloorEvents {
 public:
  FloorEvents(Traffic& traffic, RoutePlanner& planner) : traffic_(traffic), planner_(planner) {}

  Blockage block(const geometry::ConvexPolygon& area, std::chrono::milliseconds now);
  std::vector<Detour> unblock(std::uint32_t number);

  // It stands there and will not move; its outline is an obstacle until it comes back. Requires a vehicle
  // that has not died.
  std::vector<Detour> died(std::uint32_t vehicle, const geometry::Pose& at, std::chrono::milliseconds now);
  // It drives on along its way from this length, through its stops or straight home. F1003: somebody has to
  // pass first; ask again later.
  [[nodiscard]] result::Result<std::vector<Detour>> came_back(std::uint32_t vehicle, double here_m, bool home,
                                                              std::chrono::milliseconds now);

  // Vehicles that wait look for a way again.
  std::vector<Detour> retry(std::chrono::milliseconds now);

  // What is still to be done on its way behind this length, its home at last.
  std::vector<Waypoint> stops_behind(std::uint32_t vehicle, double arc_m) const;

 private:
  std::optional<double> first_blocked_m(std::uint32_t vehicle) const;
  std::vector<Detour> detour_all(std::chrono::milliseconds now);
  Detour detour(std::uint32_t vehicle, std::chrono::milliseconds now);
  std::vector<Detour> release_free();
  std::vector<std::uint32_t> block_held();

  Traffic& traffic_;
  RoutePlanner& planner_;
  std::map<std::uint32_t, std::uint32_t> dead_;  // vehicle to its place among the blocked ones
};

}  // namespace stepwright::fleet

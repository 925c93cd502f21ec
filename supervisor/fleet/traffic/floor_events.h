#pragma once

// Events on the floor while vehicles drive: places that are blocked, vehicles that die and come back. Keeps
// traffic and route planner in step, and says what became of every vehicle concerned.
//
// One thread at a time; both must outlive it. A vehicle whose way leads through a blocked place may at once
// go no farther than to there; then it is planned anew from where it can stop. Who finds no way goes home;
// who finds none there either, or for whom there is no schedule, waits, and others drive around it where they
// can. The room that a dead vehicle needs to begin to drive again is kept free where other ways lead around
// it; where none does others drive through in one go, and it comes back when nobody is there. Once it has
// asked in vain nobody gets another way through it. Missions do not end there.
//
//   FloorEvents events(traffic, planner);
//   const auto blocked = events.block(area, now);
//   for (const Detour& detour : blocked.detours) report(detour);
//   ...
//   for (const Detour& detour : events.unblock(blocked.number)) report(detour);

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
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

  // It stands there and will not move; its outline is an obstacle until it comes back, longer by what it may
  // have come since it last told its speed. Requires a vehicle that has not died.
  std::vector<Detour> died(std::uint32_t vehicle, const geometry::Pose& at, std::chrono::milliseconds now);
  // It drives on along its way from this length, through its stops or straight home. F1003: somebody has to
  // pass first, through its room perhaps; ask again later. Those are only who have a way through it when it
  // asks for the first time.
  [[nodiscard]] result::Result<std::vector<Detour>> came_back(std::uint32_t vehicle, double here_m, bool home,
                                                              std::chrono::milliseconds now);

  // Vehicles that wait look for a way again.
  std::vector<Detour> retry(std::chrono::milliseconds now);

  // Remaining stops on its way behind this length, its home at last.
  std::vector<Waypoint> stops_behind(std::uint32_t vehicle, double arc_m) const;

 private:
  struct Dead {
    std::uint32_t number = 0;  // among the blocked places
    geometry::ConvexPolygon outline;
    Room room;  // around it
  };
  // A vehicle that may not go on, and the polygons that it may be in.
  struct Held {
    std::pair<std::uint32_t, std::uint32_t> permitted;  // polygons: the first one, and one behind the last
    std::vector<std::uint32_t> places;                  // to avoid
  };
  using Meets = bool (RoutePlanner::*)(const geometry::Pose&) const;

  std::optional<double> first_m(std::uint32_t vehicle, double from_m, Meets meets) const;
  std::optional<double> first_blocked_m(std::uint32_t vehicle) const;
  geometry::ConvexPolygon begin_of_way(std::uint32_t vehicle, const geometry::ConvexPolygon& room) const;
  std::span<const geometry::PathPose> first_piece(std::uint32_t vehicle, double here_m,
                                                  std::span<const Waypoint> stops) const;
  // First nobody goes farther than he may, then one after the other is planned for.
  std::vector<std::uint32_t> hold_blocked();
  std::vector<Detour> detour_all(std::span<const std::uint32_t> vehicles, std::chrono::milliseconds now);
  Detour detour(std::uint32_t vehicle, std::chrono::milliseconds now);
  void mark_held(std::uint32_t vehicle);
  void leave_rooms(std::chrono::milliseconds now, std::vector<Detour>& detours);
  std::vector<Detour> release_free();
  std::vector<std::uint32_t> block_waiting(std::uint32_t dead);

  Traffic& traffic_;
  RoutePlanner& planner_;
  std::map<std::uint32_t, Dead> dead_;
  std::map<std::uint32_t, Held> held_;
};

}  // namespace stepwright::fleet

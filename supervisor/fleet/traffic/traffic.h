#pragma once

// Traffic control of a plan in execution: which vehicle may enter which polygon now, and what changes when a
// vehicle is late, gets a new mission, cannot go on or comes back.
//
// No clock, no I/O, no random numbers: times and measurements are passed in, the same calls give the same
// answers. One thread at a time. Invariants:
//  - No two vehicles are permitted in polygons that overlap: each pair of polygons still to come has an order
//    (Mode::Strict), and the later one is permitted when the earlier one has been left.
//  - What is permitted stays so, along the same way. A new way begins at a place where the vehicle can still
//  come to rest.
//  - There is always a schedule in which every vehicle comes to the end of its way. A change for which there
//    is none is refused and changes nothing. So vehicles never wait for each other in a circle
//    (supervisor/doc/fleet_traffic.md).
//
//   auto traffic = Traffic::create(routes, {}, now);
//   traffic->progress(3, {.arc_m = 12.4, .speed_m_s = 1.1}, now);
//   const Permission permission = traffic->permission(3, now);   // to the vehicle's PathFollower
//   const auto branch = traffic->branch(3);                       // plan from branch->pose, then:
//   if (!traffic->reroute(3, *branch, continuation, now)) keep_the_old_way();

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/control/speed_plan.h"
#include "supervisor/fleet/schedule/retiming.h"
#include "supervisor/fleet/traffic/internal/lane.h"
#include "supervisor/fleet/traffic/route.h"

namespace stepwright::fleet {

struct TrafficSettings {
  double ahead_m = 6.0;                  // of the vehicle, permissions are given; more than it needs to stop
  double brake_m_s2 = 0.5;               // counted on for a new way
  double reaction_m = 1.0;               // before that braking begins
  double resolution_m = 0.2;             // of the lattice; a new way begins at one of its poses
  double slowest_gate_m_s = 0.3;         // who would have to come more slowly goes on and stands
  std::chrono::milliseconds late{1000};  // later than scheduled by so much is a delay
  std::chrono::milliseconds held{600'000};  // how long a vehicle that is held is taken to stand
  std::uint64_t conflicts = 500;            // budget of a search for orders
};

// Measurements of a vehicle. Arc lengths are those of its route.
struct VehicleLocation {
  double arc_m = 0.0;                           // at a stop or the end: that of the stop or the end
  double speed_m_s = 0.0;                       // along the way
  std::chrono::milliseconds standing_until{0};  // at a stop
};

struct Permission {
  double permitted_m = 0.0;
  std::optional<Gate> gate;  // when the place up to which it may go is expected to open
};

// A place ahead from which a vehicle may be given another way.
struct Branch {
  std::size_t pose = 0;  // index into the path
  double arc_m = 0.0;
  geometry::Pose place;
};

// How a change came about.
struct Change {
  bool orders_kept = false;     // only the vehicle's own orders were searched, others kept theirs
  std::uint64_t conflicts = 0;  // of the search
};

class Traffic {
 public:
  // Vehicles are numbered in the order of their routes. Each stands at the begin of its route, or, if its
  // path has one pose, rests there. F1003: there is no schedule.
  [[nodiscard]] static result::Result<Traffic> create(std::vector<Route> routes,
                                                      const TrafficSettings& settings,
                                                      std::chrono::milliseconds now);

  // --- measurements ---
  // A vehicle that is later than scheduled is one more constraint; all times follow.
  void progress(std::uint32_t vehicle, const VehicleLocation& at, std::chrono::milliseconds now);
  // As if every vehicle had kept its earliest times up to now: for what-if runs without a plant.
  void keep_times(std::chrono::milliseconds now);

  // --- what vehicles may do ---
  Permission permission(std::uint32_t vehicle, std::chrono::milliseconds now) const;
  // Whether the next polygons that it needs overlap the room of this one, which is removed.
  bool is_before_room(std::uint32_t vehicle, std::uint32_t removed) const;
  // Whose polygon keeps it from being permitted the next one; nothing if nobody's does.
  std::optional<std::uint32_t> waits_for(std::uint32_t vehicle) const;

  // --- changes; F1003: there is no schedule with it, and nothing has changed ---
  // The first place on its way from which it could take another one, if there is any. A vehicle that rests
  // branches off where it is.
  std::optional<Branch> branch(std::uint32_t vehicle) const;
  [[nodiscard]] result::Result<Change> reroute(std::uint32_t vehicle, const Branch& branch,
                                               const Route& continuation, std::chrono::milliseconds now);
  // It may not go farther than this until it is released or gets another way. Orders stay.
  void hold(std::uint32_t vehicle, double arc_m);
  void release(std::uint32_t vehicle);
  // It is not driven on and takes no part any more. That others do not drive into it is for their ways. In
  // its room, if it has any, nobody waits until it is restored: new ways are permitted the polygons that
  // overlap it together with the first one behind it.
  void remove(std::uint32_t vehicle, std::optional<geometry::ConvexPolygon> room = {});
  // So are ways that were there before, but for what is permitted already and for ways that would leave no
  // schedule.
  void clear_rooms(std::chrono::milliseconds now);
  [[nodiscard]] result::Result<Change> restore(std::uint32_t vehicle, Route route,
                                               std::chrono::milliseconds now);

  // --- what is ---
  std::uint32_t vehicles() const { return static_cast<std::uint32_t>(lanes_.size()); }
  const Route& route(std::uint32_t vehicle) const { return lanes_[vehicle].route; }
  double arc_m(std::uint32_t vehicle) const { return lanes_[vehicle].arc_m; }
  double speed_m_s(std::uint32_t vehicle) const { return lanes_[vehicle].speed_m_s; }  // as last told
  std::chrono::milliseconds standing_until(std::uint32_t vehicle) const {
    return lanes_[vehicle].standing_until;
  }
  // Polygons first to granted - 1 are permitted and not left.
  std::uint32_t first(std::uint32_t vehicle) const { return lanes_[vehicle].first; }
  std::uint32_t granted(std::uint32_t vehicle) const { return lanes_[vehicle].granted; }
  bool removed(std::uint32_t vehicle) const { return lanes_[vehicle].removed; }
  bool held(std::uint32_t vehicle) const { return lanes_[vehicle].limit_m.has_value(); }
  bool rests(std::uint32_t vehicle) const;
  // Orders of the last schedule, also those that have come true: by polygon, whose must have been left
  // before.
  std::span<const internal::Wait> waits(std::uint32_t vehicle) const { return lanes_[vehicle].waits; }
  // When it comes to the end of its way as things stand.
  std::chrono::milliseconds expected_end(std::uint32_t vehicle) const;
  // When it is expected to have passed the place, as `keep_times` would have it.
  std::chrono::milliseconds expected(std::uint32_t vehicle, double arc_m) const;
  std::uint64_t delays() const { return delays_; }  // posted so far

 private:
  struct Planned {
    internal::Remainder remainder;
    std::vector<SpatialPair> overlaps;  // as overlaps_
    Schedule made;
    Change change;
  };
  // From where, on the clock of its pace, and when a vehicle drives on in a polygon.
  struct Start {
    std::chrono::milliseconds time{0};
    double at_s = 0.0;
  };

  explicit Traffic(const TrafficSettings& settings) : settings_(settings) {}
  [[nodiscard]] result::Result<Change> adopt(std::uint32_t vehicle, internal::Lane candidate,
                                             std::chrono::milliseconds now);
  // `changed`: the one of the lanes that is new.
  [[nodiscard]] result::Result<Planned> plan(const std::vector<const internal::Lane*>& lanes,
                                             std::optional<std::uint32_t> changed,
                                             std::chrono::milliseconds now) const;
  void install(Planned planned, std::chrono::milliseconds now);
  bool open(std::uint32_t vehicle, std::uint32_t polygon) const;
  // Whether a vehicle that takes no part is permitted a polygon that overlaps this one, or it is in its room.
  bool room_of_removed(const geometry::ConvexPolygon& area) const;
  // Of vehicles that take no part, but for this one.
  std::vector<geometry::ConvexPolygon> rooms_of_others(std::uint32_t vehicle) const;
  // The first polygon behind this one that is not needed together with it.
  std::uint32_t behind_group(std::uint32_t vehicle, std::uint32_t polygon) const;
  void leave(std::uint32_t vehicle);
  void grant(std::uint32_t vehicle);
  void post_delay(std::uint32_t vehicle, std::chrono::milliseconds now);
  Start start_in(std::uint32_t vehicle, std::uint32_t polygon) const;
  PolygonRef row_of(std::uint32_t vehicle, std::uint32_t polygon) const;
  std::chrono::milliseconds entry(std::uint32_t vehicle, std::uint32_t polygon) const;
  std::chrono::milliseconds exit(std::uint32_t vehicle, std::uint32_t polygon) const;

  TrafficSettings settings_;
  std::vector<internal::Lane> lanes_;
  std::vector<SpatialPair> overlaps_;  // internal::overlaps_ahead of the lanes as last planned
  std::optional<Retiming> retiming_;
  std::chrono::milliseconds since_{0};  // time zero of the times of retiming_
  std::uint64_t delays_ = 0;
};

}  // namespace stepwright::fleet

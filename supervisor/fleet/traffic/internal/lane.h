#pragma once

// A vehicle as traffic keeps it, and what is still to be scheduled of all of them. Values; pure functions.

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "supervisor/fleet/schedule/problem.h"
#include "supervisor/fleet/schedule/sections.h"
#include "supervisor/fleet/traffic/route.h"

namespace stepwright::fleet::internal {

// Polygon `polygon` of the vehicle's own only after polygon `left` of the other one has been left.
struct Wait {
  std::uint32_t polygon = 0;
  std::uint32_t vehicle = 0;
  std::uint32_t left = 0;
};

struct Lane {
  Route route;
  std::uint32_t first = 0;    // polygon that it has not left yet
  std::uint32_t granted = 1;  // one behind the last polygon permitted
  double arc_m = 0.0;
  double speed_m_s = 0.0;
  std::chrono::milliseconds standing_until{0};
  std::optional<double> limit_m;  // held: it may not go farther
  bool removed = false;
  std::optional<geometry::ConvexPolygon> room;  // removed: where nobody is to wait
  // Of the last schedule:
  std::vector<Wait> waits;                  // by polygon
  std::uint32_t row = 0;                    // of its envelope
  std::uint32_t base = 0;                   // its polygon that is polygon 0 there
  double planned_from_s = 0.0;              // where it was then, on the clock of its pace,
  std::chrono::milliseconds planned_go{0};  // and when it drove on from there
};

// The rest of all ways: an envelope for each vehicle that takes part, from its present polygon on.
struct Remainder {
  std::vector<std::uint32_t> vehicles;  // by row
  std::vector<TrajectoryEnvelope> envelopes;
  std::vector<TemporalConstraint> constraints;
};

// Time zero is `now`; `held` is how long vehicles with a limit stand.
Remainder remainder_of(std::span<const Lane* const> lanes, std::chrono::milliseconds now,
                       std::chrono::milliseconds held);

// Polygons still ahead that overlap in space, of vehicles that take part: `vehicle` is the lane, `polygon`
// that of its route. In the order of overlapping_pairs. `known`: what this was for the same lanes before, of
// which the changed one alone is new; without it all is worked out.
std::vector<SpatialPair> overlaps_ahead(std::span<const Lane* const> lanes,
                                        std::span<const SpatialPair> known,
                                        std::optional<std::uint32_t> changed);

// The same by row and polygon of the remainder.
std::vector<SpatialPair> by_row(std::span<const Lane* const> lanes, std::span<const SpatialPair> ahead);

// That polygons already permitted come before all others that overlap them.
void keep_permissions(std::span<const Lane* const> lanes, std::span<const SpatialPair> rows,
                      Remainder& remainder);

// That vehicles other than `changed` keep the orders that they have among themselves.
void keep_orders(std::span<const Lane* const> lanes, std::uint32_t changed, Remainder& remainder);

}  // namespace stepwright::fleet::internal

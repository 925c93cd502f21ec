#pragma once

// From routes to missions: legs joined to one path, stops on it, polygons along it. Pure functions but for
// the floor, whose paths they read.

#include <span>

#include "supervisor/fleet/mission/internal/route.h"

namespace stepwright::fleet::internal {

// Requires prepared legs that all have a path; `legs` may come from elsewhere.
geometry::Path join_legs(std::span<const LatticePath* const> legs);

// The stops of a route on a path that was joined of `legs`, from its pose `begin` on; one for each leg.
std::vector<Stop> stops_on(const MissionProblem& problem, const Route& route,
                           std::span<const LatticePath* const> legs);

// The way behind its lead-in, which ends where the way begins; stops go with it.
geometry::Path behind(const geometry::Path& lead_in, geometry::Path way, std::vector<Stop>& stops);

// The mission of a vehicle along its route: its lead-in, then these legs.
[[nodiscard]] result::Result<VehicleMission> route_mission(const MissionProblem& problem, std::size_t vehicle,
                                                           const Route& route,
                                                           std::span<const LatticePath* const> legs,
                                                           const OccupancyGrid& map,
                                                           const EnvelopeOptions& options);

// The mission of a vehicle along its path; polygons grow on `map`. F0503 if that cannot be.
[[nodiscard]] result::Result<VehicleMission> build_mission(const MissionProblem& problem, std::size_t vehicle,
                                                           geometry::Path path, std::vector<Stop> stops,
                                                           const OccupancyGrid& map,
                                                           const EnvelopeOptions& options);

// A mission and another one of the same vehicle behind it, which begins where it ends and counts poses,
// polygons and metres from its own begin. Where they meet the vehicle stands for as long as it likes.
VehicleMission joined(VehicleMission first, VehicleMission second);

// A vehicle of which the problem gives the envelope.
VehicleMission given_mission(const MissionProblem& problem, std::size_t vehicle);

// The stands of stops, for grow_between_stands.
std::vector<Stand> stands_of(std::span<const Stop> stops);

}  // namespace stepwright::fleet::internal

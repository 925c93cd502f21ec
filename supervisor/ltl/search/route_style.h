#pragma once

// How routes are asked for and driven: what a train of that length needs for its turns, and by chance another
// style. Pure functions but for the dice; any thread with dice of its own.
//
//   const Route route = ways.route(route_query(model, mark, tightest_m(model), 1.0, 0.0, seed, stop));
//   const Drive drive = driver.along(route, mark, plain_style(model));

#include <cstdint>
#include <random>

#include "supervisor/ltl/search/driver.h"
#include "supervisor/ltl/search/search_ground.h"

namespace stepwright::ltl {

DriveStyle plain_style(const TrainModel& model);
DriveStyle style_by_chance(const TrainModel& model, std::mt19937_64& dice);

// From there, with so much room as a share of what its trailers are expected to need.
RouteQuery route_query(const TrainModel& model, const DriveMark& from, double turn_m, double room,
                       double noise, std::uint64_t seed, const Stop& stop);

}  // namespace stepwright::ltl

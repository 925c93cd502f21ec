#pragma once

// Invariants of traffic that keep vehicles from ever waiting for each other in a circle
// (supervisor/doc/fleet_traffic.md, "Why there is no deadlock"), looked at from outside and long before
// anybody stands.
//
// Pure functions of what traffic says; any thread, while nobody changes it.
//
//   EXPECT_EQ(support::broken_invariant(traffic), "");

#include <string>

#include "supervisor/fleet/traffic/traffic.h"

namespace stepwright::support {

// A place where the vehicle would have to wait while it is still in two polygons; empty if there is none.
// `first`: polygons before it have been left.
std::string waits_in_two_polygons(const fleet::Route& route, std::uint32_t first);

// The same for the ways of all vehicles; and permissions that wait for each other in a circle, also if
// nobody has come to that place yet.
std::string broken_invariant(const fleet::Traffic& traffic);

}  // namespace stepwright::support

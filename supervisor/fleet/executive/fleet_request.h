#pragma once

// Requests of people to a fleet that runs. Values; any thread.
//
//   FleetChange{OrderChange{"order 44", "rack 1", "outbound A", 1}}

#include <cstdint>
#include <string>
#include <variant>

#include "supervisor/geometry/convex_polygon.h"

namespace stepwright::fleet {

// A new load, or another amount of one that is known by its name.
struct OrderChange {
  std::string name;
  std::string from;  // locations of the problem
  std::string to;
  std::uint32_t amount = 1;
};

// Nobody is to drive there until it is free again.
struct Blocked {
  std::string name;
  geometry::ConvexPolygon area;
};
struct BlockChange {
  Blocked place;
};
struct UnblockChange {
  std::string name;
};

// A vehicle that stopped by itself is to take part again; whoever says so has seen to what stopped it. Its
// error is reset with that.
struct ReturnChange {
  std::string vehicle;
};

// Everybody comes to rest where he may, and stays there.
struct HoldChange {};

// The fleet goes on after that, or after an emergency stop; whoever says so has released it and sees
// everybody clear.
struct ResumeChange {};

using FleetChange =
    std::variant<OrderChange, BlockChange, UnblockChange, ReturnChange, HoldChange, ResumeChange>;

// At the first decision at or after that time of the scan clock.
struct TimedRequest {
  double at_s = 0.0;
  FleetChange change;
};

}  // namespace stepwright::fleet

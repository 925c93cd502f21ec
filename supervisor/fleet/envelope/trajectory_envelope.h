#pragma once

// Trajectory envelopes (Pecora and Cirillo 2012, definition 1): where a vehicle may be, and for how long.
//
// A value; any thread may read. The polygons are in the order in which the vehicle enters them; each overlaps
// the next one. A vehicle is within polygon k from its entry s(k) to its exit e(k); it enters polygon k + 1
// before it leaves k.
//
//   TrajectoryEnvelope{.vehicle = "v1",
//                      .polygons = {{area, {4s, 40s}, {1s, 10s}}, {next_area, {6s, 60s}, {}}}};

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/geometry/convex_polygon.h"

namespace stepwright::fleet {

struct Bounds {
  std::chrono::milliseconds least{0};
  std::chrono::milliseconds most{0};

  friend bool operator==(const Bounds&, const Bounds&) = default;
};

struct EnvelopePolygon {
  geometry::ConvexPolygon area;
  Bounds stay;     // e(k) - s(k): the set D of the definition
  Bounds overlap;  // e(k) - s(k + 1): the set O; of no meaning in the last polygon
  // It is not left before so many polygons behind it have been entered: one, or more where whatever drives
  // the vehicle could not have it wait among them and be out of this one. Those behind the last one do not
  // count.
  std::uint32_t left_into = 1;
};

struct TrajectoryEnvelope {
  std::string vehicle;
  std::vector<EnvelopePolygon> polygons;  // at least one
};

}  // namespace stepwright::fleet

#pragma once

// Scenario of a shift, drawn from a seed before it begins: transports with deadlines, delays, blocked aisles,
// vehicles that die. The same seed gives the same shift for every fleet. Values; pure functions.
//
//   const Scenario scenario = draw_scenario({.vehicles = 20, .hours = 8.0, .seed = 1});

#include <cstdint>
#include <vector>

#include "supervisor/geometry/convex_polygon.h"
#include "tests/support/fleet/floor_maps.h"

namespace stepwright::bench::shift {

struct ScenarioSettings {
  std::uint32_t vehicles = 20;
  double hours = 8.0;
  double transports_per_hour = 130.0;
  double pauses_per_hour = 2.0;  // of each vehicle: somebody stands in front of its scanner
  std::uint32_t blockages_per_hour = 2;
  double breakdowns_per_hour = 0.5;  // at least one in a shift; the first one is for good
  std::uint64_t seed = 1;
};

struct Transport {
  double release_s = 0.0;
  double due_s = 0.0;
  std::uint32_t from = 0;  // stations
  std::uint32_t to = 0;
  double pick_up_s = 0.0;  // what standing there really takes; planned with kService_s
  double set_down_s = 0.0;
};
inline constexpr double kService_s = 20.0;

struct Closing {
  double begin_s = 0.0;
  double seconds = 0.0;
  std::uint32_t place = 0;  // into Scenario::places
};

struct Pause {
  std::uint32_t vehicle = 0;
  double begin_s = 0.0;
  double seconds = 0.0;
};

struct Breakdown {
  std::uint32_t vehicle = 0;
  double begin_s = 0.0;
  double seconds = 0.0;
  bool for_good = false;
};

struct Rectangle {
  geometry::Point low;
  geometry::Point high;
  geometry::ConvexPolygon polygon() const;
};

struct Scenario {
  ScenarioSettings settings;
  support::DrawnHall hall;
  std::vector<geometry::Pose> stations;
  std::vector<Transport> transports;  // by release
  std::vector<Rectangle> places;      // that may be blocked
  std::vector<Closing> closings;      // by begin; no place twice at once
  std::vector<Pause> pauses;          // by begin
  std::vector<Breakdown> breakdowns;  // by begin

  double end_s() const { return 3600.0 * settings.hours; }
};

Scenario draw_scenario(const ScenarioSettings& settings);

}  // namespace stepwright::bench::shift

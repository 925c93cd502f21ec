#pragma once

// Greatest speeds of a vehicle along a way that ends at rest, by its curves, the rate of the steering, and
// braking before what is slower. Controllers and programs drive by them. Pure.
//
//   std::vector<SpeedStation> stations = {{.sharpest_1_m = 0.25, .to_next_m = 0.1}, ...};
//   const std::vector<double> speeds = greatest_speeds(stations, limits);   // the last one is 0

#include <span>
#include <vector>

namespace stepwright::vehicle {

// Paths of arcs ask the steering to turn at once: it has this way for it, half before and half behind.
inline constexpr double kSteeringWindow_m = 1.0;

struct SpeedLimits {
  double top_speed_m_s = 1.5;
  double brake_m_s2 = 0.6;
  double lateral_m_s2 = 0.8;  // of a curve, at most
  double lock_rate_rad_s = 0.5;
};

struct SpeedStation {
  double sharpest_1_m = 0.0;  // curvature around it, not negative
  double turn_rad = 0.0;      // by which the steering differs over kSteeringWindow_m, of either sign
  double to_next_m = 0.0;     // of the way; of no meaning at the last one
};

// One for each station, of which there is at least one.
std::vector<double> greatest_speeds(std::span<const SpeedStation> stations, const SpeedLimits& limits);

}  // namespace stepwright::vehicle

#pragma once

// The figures of a tugger train, a tractor that pulls trailers, and of the hall that it drives in. Metres,
// seen from above. The tractor is driven at its rear axle, whose middle is its reference point, and steered
// at the front; see plant_models/doc/tugger.md.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "plant_models/assemblies/floor_polygon.h"
#include "runtime/ground/result/result.h"

namespace stepwright::assemblies {

inline constexpr std::size_t kMostTuggerTrailers = 15;

// Links are boxes of one size, the tractor's around its reference point.
struct TuggerLinks {
  double wheelbase_m = 1.0;  // of the tractor
  double hitch_m = 1.0;      // from the axle in front to the trailer's own
  double length_m = 0.9;
  double width_m = 0.5;
  double spacing_m = 1.0;  // the middle of a trailer lies so far behind that of the link in front
};

// Speed of the drive wheels: a first-order controller whose force is limited. The force is what gives the
// named changes of speed with as many trailers as there can be; with fewer the train is faster.
struct TuggerDrive {
  double top_speed_m_s = 2.0;  // forward and in reverse
  double time_constant_s = 0.3;
  double acceleration_m_s2 = 1.0;
  double braking_m_s2 = 2.0;       // of the controller
  double spring_brake_m_s2 = 2.5;  // that holds while the drive is not enabled
  double tractor_kg = 300.0;
  double trailer_kg = 150.0;  // each
};

struct TuggerSteering {
  double full_lock_rad = 1.0;
  double time_constant_s = 0.15;
  double rate_rad_s = 1.0;
};

// How the ground is left. Without all of it the links move as a planner's equations say.
struct TuggerSlip {
  double drive_slip = 0.01;         // 0..1; part of the wheels' speed that the tractor does not make
  double understeer_s2_m2 = 0.01;   // curvature / (1 + k v^2)
  double hitch_slip_s2_m2 = 0.005;  // trailers turn by (1 + k v^2) of what they would: they run wider

  static constexpr TuggerSlip none() { return {0.0, 0.0, 0.0}; }
};

// Standard deviations; white from one step to the next.
struct TuggerNoise {
  double position_m = 0.01;
  double heading_rad = 0.002;
  double speed_m_s = 0.01;
  double hitch_rad = 0.002;

  static constexpr TuggerNoise none() { return {0.0, 0.0, 0.0, 0.0}; }
};

struct TuggerParameters {
  TuggerLinks links;
  TuggerDrive drive;
  TuggerSteering steering;
  TuggerSlip slip;
  TuggerNoise noise;
  std::size_t trailers = 5;             // coupled at the start, in one line behind the tractor
  std::size_t most_trailers = 0;        // that can ever be coupled; less than `trailers`: as many as those
  body2d::Pose start;                   // of the reference point
  std::vector<FloorPolygon> walls;      // nothing passes them from the inside; none: the floor has no end
  std::vector<FloorPolygon> obstacles;  // stand on the floor
  std::vector<FloorPolygon> blockages;  // do while the fault block_1, block_2, ... holds
  std::vector<FloorPolygon> places;     // with a loop in the floor, by their names
  double scanner_m = 2.5;               // how far in front of the tractor it sees blockages
  std::uint64_t seed = 1;
};

// Trailers that there are terminals for.
std::size_t most_trailers(const TuggerParameters& parameters);

// Fails with one C0321 per figure that has no physical sense, or outline that is no simple polygon. Whether
// the train stands in a wall is not looked at.
[[nodiscard]] result::Result<void> validate(const TuggerParameters& parameters);

}  // namespace stepwright::assemblies

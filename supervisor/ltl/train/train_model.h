#pragma once

// A car that pulls trailers, as a planner sees it: its state, the equations of motion in both readings of E.
// Plaku, Planning Robot Motions to Satisfy Linear Temporal Logic, Geometric, and Differential Constraints
// (2012), section 2.5, its limits, and where its links are. Metres, radians, seconds.
//
// Values and pure functions; any thread. Example:
//   TrainModel model{.trailers = 5};
//   TrainState state = standing_at(model, {2.0, 3.0, 0.0});   // straight, at rest
//   const TrainState change = rate(model, state, {.acceleration_m_s2 = 1.0});

#include <array>
#include <cstddef>
#include <cstdint>

#include "runtime/ground/result/result.h"
#include "supervisor/geometry/point.h"

namespace stepwright::ltl {

inline constexpr std::size_t kMostTrailers = 15;

// Places of the state; what lies behind the last trailer is zero.
inline constexpr std::size_t kTrainX = 0;        // m, of the car's reference point
inline constexpr std::size_t kTrainY = 1;        // m
inline constexpr std::size_t kTrainHeading = 2;  // rad, not wrapped
inline constexpr std::size_t kTrainSpeed = 3;    // m/s, negative in reverse
inline constexpr std::size_t kTrainLock = 4;     // rad, steering; positive turns left when driving forward
inline constexpr std::size_t kTrainTrailer = 5;  // rad, heading of the first trailer, and so on
inline constexpr std::size_t kTrainStates = kTrainTrailer + kMostTrailers;
using TrainState = std::array<double, kTrainStates>;

// The last factor of a trailer's rate of turning.
enum class HitchReading : std::uint8_t {
  Pulled,   // sin(h[i-1] - h[i]): S. M. LaValle, Planning Algorithms (2006), section 13.1.2.4
  Printed,  // sin h[i-1] - sin h[i], as the paper has it
};

struct TrainModel {
  std::size_t trailers = 0;
  HitchReading reading = HitchReading::Pulled;
  double hitch_m = 1.0;      // d of the equations: from the axle in front to the trailer's own
  double wheelbase_m = 1.0;  // of the car
  // Links are boxes of one size; the middle of a trailer lies so far behind that of the link in front.
  double length_m = 0.9;
  double width_m = 0.5;
  double spacing_m = 1.0;
  // Limits of states and controls, in both directions.
  double most_speed_m_s = 2.0;
  double most_lock_rad = 1.0;
  double most_acceleration_m_s2 = 1.0;
  double most_lock_rate_rad_s = 1.0;
  double most_hitch_rad =
      3.15;  // between neighbours; more than half a turn: hitches bend as far as they like

  std::size_t links() const { return trailers + 1; }
  std::size_t states() const { return kTrainTrailer + trailers; }
};

// L0301 for each figure that has no physical sense.
[[nodiscard]] result::Result<void> validate(const TrainModel& model);

struct TrainControl {
  double acceleration_m_s2 = 0.0;
  double lock_rate_rad_s = 0.0;

  friend bool operator==(const TrainControl&, const TrainControl&) = default;
};

// All links in one line, at rest, the wheels straight.
TrainState standing_at(const TrainModel& model, const geometry::Pose& pose);

// The time derivative. Limits are the business of who integrates.
TrainState rate(const TrainModel& model, const TrainState& state, const TrainControl& control);

// A rectangle that turns with a link; its size is the model's.
struct LinkBox {
  geometry::Point middle;
  geometry::Point ahead;  // of length 1
};
using LinkBoxes = std::array<LinkBox, kMostTrailers + 1>;  // as many count as there are links
LinkBoxes link_boxes(const TrainModel& model, const TrainState& state);

// Whether two links share inner points (separating axes).
bool overlaps(const TrainModel& model, const LinkBox& a, const LinkBox& b);
// Whether two links that are not neighbours do, or a hitch is bent further than it may: then the state is no
// valid one.
bool meets_itself(const TrainModel& model, const LinkBoxes& boxes);

}  // namespace stepwright::ltl

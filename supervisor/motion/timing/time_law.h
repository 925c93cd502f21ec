#pragma once

// When a place on a path is reached: s as a function of time, in rows of one polynomial each (doc:
// supervisor/doc/motion_timing.md).
//
//   const auto now = law.at(0.25);   // now.place, now.speed, now.acceleration, now.jerk
//
// A value; any thread. Place, speed and acceleration are continuous; the jerk is bounded.

#include <array>
#include <cstddef>
#include <vector>

namespace stepwright::motion {

// s = c[0] + x (c[1] + ... x c[5]), x from 0 to 1 within `duration` seconds.
struct TimeRow {
  double duration = 0.0;
  std::array<double, 6> c{};
};

struct Along {
  double place = 0.0, speed = 0.0, acceleration = 0.0, jerk = 0.0;
};

// Of a row at x = 0 to 1.
Along along(const TimeRow& row, double x);

struct TimeLaw {
  std::vector<TimeRow> rows;

  // Sum of the rows' in their order.
  double duration() const;
  // Before the begin and after the end it rests there. Where the jerk jumps, that of the row that begins.
  Along at(double time) const;
};

}  // namespace stepwright::motion

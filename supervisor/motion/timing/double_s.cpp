#include "supervisor/motion/timing/double_s.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stepwright::motion {

namespace {

// A change of speed as fast as possible: jerk, constant acceleration, jerk.
struct SpeedChange {
  double jerk_time = 0.0, constant_time = 0.0, jerk = 0.0;
  double time() const { return 2.0 * jerk_time + constant_time; }
};

SpeedChange change(double from, double to, const AxisLimits& limits) {
  const double gap = std::abs(to - from);
  SpeedChange made;
  made.jerk = to >= from ? limits.jerk : -limits.jerk;
  // A phase of jerk up to the greatest acceleration and back changes the speed by A^2 / J.
  if (gap * limits.jerk < limits.acceleration * limits.acceleration) {
    made.jerk_time = std::sqrt(gap / limits.jerk);
  } else {
    made.jerk_time = limits.acceleration / limits.jerk;
    made.constant_time = std::max(0.0, gap / limits.acceleration - made.jerk_time);
  }
  return made;
}

// The course is symmetric about its middle: the mean speed is that of its ends.
double distance(double from, double to, const AxisLimits& limits) {
  return 0.5 * (from + to) * change(from, to, limits).time();
}

double distance_by(double start, double peak, const AxisLimits& limits) {
  return distance(start, peak, limits) + distance(peak, 0.0, limits);
}

// The speed between two at which the whole way is `length`: to the last bit, so the same everywhere. Requires
// that `shorter` needs less room than that.
double peak_for(double length, double start, double shorter, double longer, const AxisLimits& limits) {
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (shorter + longer);
    if (middle == shorter || middle == longer) break;
    (distance_by(start, middle, limits) <= length ? shorter : longer) = middle;
  }
  return shorter;
}

class Rows {
 public:
  explicit Rows(double speed) : now_{0.0, speed, 0.0, 0.0} {}

  void add(double time, double jerk) {
    if (!(time > 0.0)) return;
    TimeRow row;
    row.duration = time;
    row.c = {now_.place,
             now_.speed * time,
             0.5 * now_.acceleration * time * time,
             jerk * time * time * time / 6.0,
             0.0,
             0.0};
    now_ = {now_.place + time * (now_.speed + time * (0.5 * now_.acceleration + time * jerk / 6.0)),
            now_.speed + time * (now_.acceleration + 0.5 * time * jerk), now_.acceleration + time * jerk,
            0.0};
    rows_.push_back(row);
  }
  void add(const SpeedChange& made, double to) {
    add(made.jerk_time, made.jerk);
    add(made.constant_time, 0.0);
    add(made.jerk_time, -made.jerk);
    now_.acceleration = 0.0;  // but for rounding errors
    now_.speed = to;
  }
  std::vector<TimeRow> taken() { return std::move(rows_); }

 private:
  Along now_;
  std::vector<TimeRow> rows_;
};

}  // namespace

double stopping_distance(double speed, const AxisLimits& limits) {
  return distance(speed, 0.0, limits);
}

std::optional<std::vector<TimeRow>> double_s(double length, double start_speed, const AxisLimits& limits) {
  const double stop = stopping_distance(start_speed, limits);
  constexpr double kRounding = 1e-12;
  if (stop > length * (1.0 + kRounding)) return std::nullopt;
  double peak = limits.velocity;
  if (distance_by(start_speed, peak, limits) > length)
    peak = peak_for(length, start_speed, start_speed, limits.velocity, limits);
  const SpeedChange up = change(start_speed, peak, limits), down = change(peak, 0.0, limits);
  const double rest = length - distance(start_speed, peak, limits) - distance(peak, 0.0, limits);
  Rows rows(start_speed);
  rows.add(up, peak);
  if (rest > kRounding * length) rows.add(rest / peak, 0.0);
  rows.add(down, 0.0);
  return rows.taken();
}

}  // namespace stepwright::motion

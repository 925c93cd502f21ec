#include "tests/unit/ladder/driver/path_table.h"

#include <algorithm>
#include <cmath>

namespace stepwright::driver_test {

namespace {

// Rows from standstill to standstill over a way, beginning at `from`.
void add_section(Random& random, double from, double way, PathTable& table) {
  double time = table.duration_s;
  if (random.once_in(3)) {  // a quintic
    const double length = random.between(0.6, 2.0);
    table.rows.push_back({time, length, {from, 0.0, 0.0, 10.0 * way, -15.0 * way, 6.0 * way}});
    table.duration_s = time + length;
    return;
  }
  const double bend = random.between(0.05, 0.3), level = random.between(0.0, 0.4),
               cruise = random.between(0.0, 0.8);
  const double jerk = way / (bend * (bend + level) * (2.0 * bend + level + cruise));
  const std::array<double, 7> lengths = {bend, level, bend, cruise, bend, level, bend};
  const std::array<double, 7> jerks = {jerk, 0.0, -jerk, 0.0, -jerk, 0.0, jerk};
  double s = from, v = 0.0, a = 0.0;
  for (std::size_t k = 0; k < 7; ++k) {
    const double d = lengths[k], j = jerks[k];
    if (d <= 0.0) continue;
    table.rows.push_back({time, d, {s, v * d, 0.5 * a * d * d, j * d * d * d / 6.0, 0.0, 0.0}});
    s += d * (v + d * (0.5 * a + d * j / 6.0));
    v += d * (a + 0.5 * d * j);
    a += d * j;
    time += d;
  }
  table.duration_s = time;
}

}  // namespace

PathTable::Place PathTable::place(double time_s) const {
  Place out;
  std::size_t i = 0;
  while (i + 1 < rows.size() && time_s >= rows[i + 1].begin_s) ++i;
  const Row& row = rows[i];
  const double x = (time_s - row.begin_s) / row.length_s;
  for (int order = 0; order < 4; ++order) {
    double sum = 0.0;
    for (int k = 5; k >= order; --k) {
      double factor = row.c[static_cast<std::size_t>(k)];
      for (int n = 0; n < order; ++n) factor *= (k - n) / row.length_s;
      sum = sum * x + factor;
    }
    out.s[static_cast<std::size_t>(order)] = sum;
  }
  const double s = out.s[0];
  std::size_t k = 0;
  while (k + 2 < points.size() && s >= points[k + 1].place + points[k + 1].blend) ++k;
  const WayPoint& before = points[k];
  const WayPoint& next = points[k + 1];
  const double h = next.blend, d = s - next.place, y = h > 0.0 ? d / h : -1.0;
  const bool blended = h > 0.0 && d > -h;
  for (std::size_t j = 0; j < joints; ++j) {
    const double u = before.direction[j], du = next.direction[j] - u;
    out.q[0][j] = next.joints[j] + u * d;
    out.q[1][j] = u;
    if (!blended) continue;
    out.q[0][j] += du * h * (3.0 + 8.0 * y + 6.0 * y * y - y * y * y * y) / 16.0;
    out.q[1][j] += du * (8.0 + 12.0 * y - 4.0 * y * y * y) / 16.0;
    out.q[2][j] = du * (12.0 - 12.0 * y * y) / (16.0 * h);
    out.q[3][j] = -du * 24.0 * y / (16.0 * h * h);
  }
  return out;
}

Joints PathTable::at(double time_s) const {
  return time_s >= duration_s ? points.back().joints : place(time_s).q[0];
}

std::pair<double, double> PathTable::range(std::size_t joint) const {
  std::pair<double, double> all{1e9, -1e9};
  for (const WayPoint& point : points)
    all = {std::min(all.first, point.joints[joint]), std::max(all.second, point.joints[joint])};
  return all;
}

void PathTable::finish() {
  constexpr int kSamples = 4000;
  for (int k = 0; k <= kSamples; ++k) {
    const Place here = place(duration_s * k / kSamples);
    const auto& s = here.s;
    for (std::size_t j = 0; j < joints; ++j) {
      const double q1 = here.q[1][j], q2 = here.q[2][j], q3 = here.q[3][j];
      Demand& most = most_[j];
      most.speed = std::max(most.speed, std::abs(q1 * s[1]));
      most.acceleration = std::max(most.acceleration, std::abs(q2 * s[1] * s[1] + q1 * s[2]));
      most.jerk = std::max(most.jerk, std::abs(q3 * s[1] * s[1] * s[1] + 3.0 * q2 * s[1] * s[2] + q1 * s[3]));
    }
  }
  rate_slope = rate_bend = 1e6;
  for (std::size_t j = 0; j < joints; ++j) {
    Demand& most = most_[j];
    // Between samples it may be a little more.
    most = {1.005 * most.speed + 1e-9, 1.01 * most.acceleration + 1e-9, 1.02 * most.jerk + 1e-9};
    const double slope =
        std::min(0.5 * most.acceleration / most.speed, most.jerk / (3.0 * most.acceleration));
    rate_slope = std::min(rate_slope, slope);
  }
  for (std::size_t j = 0; j < joints; ++j)
    rate_bend = std::min(rate_bend,
                         (2.0 * most_[j].jerk - 3.0 * most_[j].acceleration * rate_slope) / most_[j].speed);
}

PathTable random_table(std::uint32_t seed) {
  Random random(seed);
  PathTable table;
  table.joints = static_cast<std::size_t>(random.whole(1, 7));
  const int count = random.whole(2, 6);
  for (int k = 0; k < count; ++k) {
    PathTable::WayPoint point;
    for (std::size_t j = 0; j < table.joints; ++j) point.joints[j] = random.between(-1.0, 1.0);
    if (k > 0) {
      PathTable::WayPoint& before = table.points.back();
      double square = 0.0;
      for (std::size_t j = 0; j < table.joints; ++j) {
        before.direction[j] = point.joints[j] - before.joints[j];
        square += before.direction[j] * before.direction[j];
      }
      const double length = std::sqrt(square);
      for (std::size_t j = 0; j < table.joints; ++j) before.direction[j] /= length;
      point.place = before.place + length;
    }
    table.points.push_back(point);
  }
  double stop = 0.0;
  for (std::size_t k = 1; k < table.points.size(); ++k) {
    const bool last = k + 1 == table.points.size();
    PathTable::WayPoint& point = table.points[k];
    const double before = point.place - table.points[k - 1].place;
    if (!last && !random.once_in(4) && table.joints > 1)
      point.blend = random.between(0.2, 0.45) * std::min(before, table.points[k + 1].place - point.place);
    if (point.blend > 0.0) continue;
    add_section(random, stop, point.place - stop, table);
    stop = point.place;
  }
  table.finish();
  return table;
}

}  // namespace stepwright::driver_test

#include "supervisor/motion/timing/time_law.h"

namespace stepwright::motion {

Along along(const TimeRow& row, double x) {
  const auto& c = row.c;
  const double rate = 1.0 / row.duration;
  return {c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5])))),
          rate * (c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * (4.0 * c[4] + x * 5.0 * c[5])))),
          rate * rate * (2.0 * c[2] + x * (6.0 * c[3] + x * (12.0 * c[4] + x * 20.0 * c[5]))),
          rate * rate * rate * (6.0 * c[3] + x * (24.0 * c[4] + x * 60.0 * c[5]))};
}

double TimeLaw::duration() const {
  double sum = 0.0;
  for (const TimeRow& row : rows) sum += row.duration;
  return sum;
}

Along TimeLaw::at(double time) const {
  if (rows.empty()) return {};
  if (time < 0.0) return {rows.front().c[0], 0.0, 0.0, 0.0};
  for (const TimeRow& row : rows) {
    if (time < row.duration) return along(row, time / row.duration);
    time -= row.duration;
  }
  return {along(rows.back(), 1.0).place, 0.0, 0.0, 0.0};
}

}  // namespace stepwright::motion

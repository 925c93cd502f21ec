#include "supervisor/translate/internal/rate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace stepwright::translate::internal {

double most_counts_from_filtered(const Sensor& sensor) {
  const std::vector<CalibrationPoint>& points = sensor.calibration.points();
  double slope = 0.0;  // counts per unit
  for (std::size_t i = 1; i < points.size(); ++i) {
    const CalibrationPoint& a = points[i - 1];
    const CalibrationPoint& b = points[i];
    slope = std::max(slope, std::abs((b.counts - a.counts) / (b.value - a.value)));
  }
  const double filter_s = static_cast<double>(sensor.filter.count()) * 1e-3;
  const double counts = (sensor.max_rate * filter_s + sensor.tolerance) * slope;
  return std::round(std::min(counts, 65'535.0));  // what no counts of 16 bits reach
}

}  // namespace stepwright::translate::internal

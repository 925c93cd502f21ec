#include "supervisor/translate/calibration.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace stepwright::translate {

namespace {

// The line through a and b at x.
double on_line(double xa, double ya, double xb, double yb, double x) {
  return ya + (x - xa) * (yb - ya) / (xb - xa);
}

}  // namespace

Calibration::Calibration(std::vector<CalibrationPoint> points) : points_(std::move(points)) {
  assert(is_calibration(points_));
}

double Calibration::counts_at(double value) const {
  std::size_t i = 1;
  while (i + 1 < points_.size() && value > points_[i].value) ++i;
  const CalibrationPoint& a = points_[i - 1];
  const CalibrationPoint& b = points_[i];
  return on_line(a.value, a.counts, b.value, b.counts, value);
}

double Calibration::value_at(double counts) const {
  std::size_t i = 1;
  while (i + 1 < points_.size() && (rising() ? counts > points_[i].counts : counts < points_[i].counts)) ++i;
  const CalibrationPoint& a = points_[i - 1];
  const CalibrationPoint& b = points_[i];
  return on_line(a.counts, a.value, b.counts, b.value, counts);
}

bool Calibration::rising() const {
  return points_[1].counts > points_[0].counts;
}

bool is_calibration(const std::vector<CalibrationPoint>& points) {
  if (points.size() < 2) return false;
  const bool rising = points[1].counts > points[0].counts;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const CalibrationPoint& a = points[i - 1];
    const CalibrationPoint& b = points[i];
    if (!std::isfinite(b.value - a.value) || !std::isfinite(b.counts - a.counts)) return false;
    if (!(b.value > a.value) || !(rising ? b.counts > a.counts : b.counts < a.counts)) return false;
  }
  return true;
}

}  // namespace stepwright::translate

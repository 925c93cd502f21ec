#pragma once

// The static calibration of a level sensor: straight lines between measured points, the outer ones extended.
// A value type; const functions from any thread.
//
//   Calibration s1({{2, 1322}, {10, 3784}});   // the paper's Table 4
//   s1.counts_at(5)     ->  2245.25
//   s1.value_at(3784)   ->  10

#include <vector>

namespace stepwright::translate {

struct CalibrationPoint {
  double value = 0.0;   // in units of the fluent, e.g. plan levels
  double counts = 0.0;  // raw counts of the input

  friend bool operator==(const CalibrationPoint&, const CalibrationPoint&) = default;
};

class Calibration {
 public:
  Calibration() = default;
  // Requires `is_calibration(points)`.
  explicit Calibration(std::vector<CalibrationPoint> points);

  double counts_at(double value) const;
  double value_at(double counts) const;
  bool rising() const;  // counts grow with the value
  const std::vector<CalibrationPoint>& points() const { return points_; }

 private:
  std::vector<CalibrationPoint> points_{{0.0, 0.0}, {1.0, 1.0}};
};

// Two points at least, all finite, values strictly rising, counts strictly rising or strictly falling.
bool is_calibration(const std::vector<CalibrationPoint>& points);

}  // namespace stepwright::translate

#include "supervisor/fleet/lattice/vehicle_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stepwright::fleet {

namespace {

constexpr double kShortest_m = 0.05;
constexpr double kLongest_m = 50.0;

class ModelCheck {
 public:
  ModelCheck(const result::Location& where, std::string_view prefix) : where_(where), prefix_(prefix) {}

  void length(double value, std::string_view key) {
    if (value >= kShortest_m && value <= kLongest_m) return;
    add("F0201",
        fmt::format("{}{} is {} m, outside {} to {} m", prefix_, key, value, kShortest_m, kLongest_m));
  }
  void add(std::string code, std::string message, std::string hint = {}) {
    found_.push_back({std::move(code), result::Severity::Error, where_, std::move(message), std::move(hint)});
  }

  std::string_view prefix() const { return prefix_; }
  result::Diagnostics& found() { return found_; }

 private:
  result::Location where_;
  std::string_view prefix_;
  result::Diagnostics found_;
};

void check_steering(const VehicleModel& vehicle, ModelCheck& report) {
  const double angle = vehicle.max_steering_rad;
  if (angle == 0.0) return;
  if (!(angle > 0.0 && angle < 0.5 * std::numbers::pi)) {
    report.add("F0201", fmt::format("{}max_steering_rad is {}, outside 0 to pi/2", report.prefix(), angle));
    return;
  }
  const double radius = vehicle.wheelbase_m / std::tan(angle);
  if (radius > vehicle.min_turning_radius_m * (1.0 + 1e-9)) {
    report.add("F0202",
               fmt::format("{0}min_turning_radius_m is {1} m, but {0}wheelbase_m {2} m and "
                           "{0}max_steering_rad {3} allow no less than {4:.3f} m",
                           report.prefix(), vehicle.min_turning_radius_m, vehicle.wheelbase_m, angle, radius),
               "the radius is at least wheelbase_m / tan(max_steering_rad)");
  }
}

}  // namespace

double VehicleModel::inscribed_radius_m() const {
  return std::min({front_m, rear_m, 0.5 * width_m});
}

double VehicleModel::circumscribed_radius_m() const {
  return std::hypot(std::max(front_m, rear_m), 0.5 * width_m);
}

result::Diagnostics check(const VehicleModel& vehicle, const result::Location& where,
                          std::string_view prefix) {
  ModelCheck report(where, prefix);
  report.length(vehicle.wheelbase_m, "wheelbase_m");
  report.length(vehicle.min_turning_radius_m, "min_turning_radius_m");
  report.length(vehicle.front_m, "front_m");
  report.length(vehicle.rear_m, "rear_m");
  report.length(vehicle.width_m, "width_m");
  if (!report.found().empty()) return std::move(report.found());
  if (vehicle.wheelbase_m > vehicle.front_m + vehicle.rear_m) {
    report.add("F0202", fmt::format("{0}wheelbase_m is {1} m, longer than the vehicle: {0}front_m {2} m and "
                                    "{0}rear_m {3} m",
                                    prefix, vehicle.wheelbase_m, vehicle.front_m, vehicle.rear_m));
  }
  check_steering(vehicle, report);
  return std::move(report.found());
}

}  // namespace stepwright::fleet

#include "supervisor/fleet/mission/internal/drawn_path.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "supervisor/fleet/lattice/motion_primitive.h"

namespace stepwright::fleet::internal {

namespace {

using geometry::Pose;
using geometry::Travel;

constexpr double kDense_m = 0.1;
constexpr double kSlip_rad = 3.0 * std::numbers::pi / 180.0;
constexpr double kRadiusSlack = 1.1;

double turned(double angle_rad) {
  return std::remainder(angle_rad, 2.0 * std::numbers::pi);
}

struct Arc {
  Travel travel = Travel::Forward;
  double length_m = 0.0;
  double turn_rad = 0.0;
  double slip_rad = 0.0;  // by how much the headings do not fit
};

Arc arc_between(const Pose& from, const Pose& to) {
  const double chord_m = geometry::distance(from.position(), to.position());
  const double along_rad = std::atan2(to.y_m - from.y_m, to.x_m - from.x_m);
  Arc arc;
  arc.turn_rad = turned(to.heading_rad - from.heading_rad);
  const double middle_rad = from.heading_rad + 0.5 * arc.turn_rad;
  double off_rad = turned(along_rad - middle_rad);
  if (std::abs(off_rad) > 0.5 * std::numbers::pi) {
    arc.travel = Travel::Reverse;
    off_rad = turned(off_rad - std::numbers::pi);
  }
  arc.slip_rad = std::abs(off_rad);
  const double half = 0.5 * std::abs(arc.turn_rad);
  arc.length_m = half < 1e-9 ? chord_m : chord_m * half / std::sin(half);
  return arc;
}

// The pose after a share of the arc.
Pose along(const Pose& from, const Pose& to, const Arc& arc, double share) {
  if (share >= 1.0) return to;
  const double turn_rad = share * arc.turn_rad;
  const double chord_m = geometry::distance(from.position(), to.position());
  const double whole = std::sin(0.5 * arc.turn_rad);
  const double part_m = std::abs(whole) < 1e-9 ? share * chord_m : chord_m * std::sin(0.5 * turn_rad) / whole;
  const double direction_rad =
      std::atan2(to.y_m - from.y_m, to.x_m - from.x_m) - 0.5 * arc.turn_rad + 0.5 * turn_rad;
  return {from.x_m + part_m * std::cos(direction_rad), from.y_m + part_m * std::sin(direction_rad),
          from.heading_rad + turn_rad};
}

std::string fault_of(const Arc& arc, const VehicleModel& model) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  if (arc.slip_rad > kSlip_rad) {
    return fmt::format("no arc leads there from the pose before: the headings are off by {:.1f} degrees",
                       arc.slip_rad * kDegrees);
  }
  if (std::abs(arc.turn_rad) * model.min_turning_radius_m <= kRadiusSlack * arc.length_m) return {};
  return fmt::format(
      "the way there from the pose before turns with a radius of {:.2f} m; {:.2f} m is the least",
      arc.length_m / std::abs(arc.turn_rad), model.min_turning_radius_m);
}

}  // namespace

DrawnPath join_poses(std::span<const Pose> poses, const VehicleModel& model) {
  DrawnPath drawn;
  if (poses.empty()) {
    drawn.fault = "has no poses";
    return drawn;
  }
  drawn.path.push_back({poses.front(), 0.0, Travel::Forward});
  double length_m = 0.0;
  for (std::size_t k = 1; k < poses.size(); ++k) {
    const Arc arc = arc_between(poses[k - 1], poses[k]);
    if (arc.length_m > kDense_m) drawn.fault = fault_of(arc, model);
    if (!drawn.fault.empty()) {
      drawn.wrong = k;
      return drawn;
    }
    const int steps = arc.length_m > kDense_m ? static_cast<int>(std::ceil(arc.length_m / kPathSample_m)) : 1;
    for (int step = 1; step <= steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      drawn.path.push_back(
          {along(poses[k - 1], poses[k], arc, share), length_m + share * arc.length_m, arc.travel});
    }
    length_m += arc.length_m;
  }
  if (drawn.path.size() > 1) drawn.path.front().travel = drawn.path[1].travel;
  return drawn;
}

}  // namespace stepwright::fleet::internal

#include "supervisor/tamp/planner/reach_order.h"

#include <algorithm>
#include <numbers>

namespace stepwright::tamp::planner {

namespace {

double margin_rad(std::span<const Arc> arcs, double angle_rad) {
  constexpr double kUnits = 2.0 * std::numbers::pi / 4294967296.0;
  const Angle angle = angle_of(angle_rad);
  for (const Arc arc : arcs) {
    if (arc.width == Arc::kFull) return std::numbers::pi;
    if (arc.contains(angle)) return (1.0 + std::min(angle - arc.low, arc.high() - angle)) * kUnits;
  }
  return 0.0;
}

}  // namespace

void ReachOrder::then(int arm, const Spot& tool) {
  const ReachBounds* const reach = model_->cell().arms[static_cast<std::size_t>(arm)].reach;
  visits_.push_back(
      reach->arcs_at({nanometres_of(tool.x_m), nanometres_of(tool.y_m), nanometres_of(tool.z_m)}));
}

double ReachOrder::picked(std::size_t visit, double angle_rad, double hand_rad) const {
  const double here = margin_rad(visits_[visit], angle_rad + hand_rad);
  if (here <= 0.0 || visit + 1 == visits_.size()) return here;
  double best = 0.0;
  for (const double each : angles_) best = std::max(best, placed(visit + 1, each, hand_rad));
  return std::min(here, best);
}

double ReachOrder::placed(std::size_t visit, double angle_rad, double hand_rad) const {
  const double here = margin_rad(visits_[visit], angle_rad + hand_rad);
  if (here <= 0.0 || visit + 1 == visits_.size()) return here;
  double best = 0.0;
  for (const double each : grasps_) best = std::max(best, picked(visit + 1, angle_rad, each));
  return std::min(here, best);
}

}  // namespace stepwright::tamp::planner

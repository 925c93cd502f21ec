#include "supervisor/tamp/drawing/plan_json.h"

#include <nlohmann/json.hpp>

namespace stepwright::tamp::drawing {

using nlohmann::json;

json plan_json(const scene::RobotCell& cell, const scene::TampPlan& plan) {
  json actions = json::array();
  for (const scene::PlannedAction& each : plan.actions) {
    json motions = json::array();
    for (const scene::Motion& motion : each.motions)
      motions.push_back(
          {{"phase", name_of(motion.phase)}, {"half_open_m", motion.half_open_m}, {"path", motion.path}});
    json one = {{"action", text_of(cell, each.what)},
                {"arm", cell.arms[static_cast<std::size_t>(each.what.arm)].name},
                {"thing", cell.things[static_cast<std::size_t>(each.what.thing)].name},
                {"motions", std::move(motions)}};
    if (each.what.surface >= 0)
      one["region"] = cell.surfaces[static_cast<std::size_t>(each.what.surface)].name;
    if (each.what.on >= 0) one["on"] = cell.things[static_cast<std::size_t>(each.what.on)].name;
    if (each.what.kind == scene::ActionKind::Pick) one["hand_rad"] = each.hand_rad;
    if (each.what.kind != scene::ActionKind::MoveAway)
      one["pose"] = {{"x_m", each.pose.x_m},
                     {"y_m", each.pose.y_m},
                     {"z_m", each.pose.z_m},
                     {"angle_rad", each.pose.angle_rad}};
    actions.push_back(std::move(one));
  }
  return actions;
}

}  // namespace stepwright::tamp::drawing

#include "supervisor/tamp/planner/interval_model.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "supervisor/tamp/intervals/arm/srs_exact.h"
#include "supervisor/tamp/intervals/arm/srs_reach.h"

namespace stepwright::tamp::planner {

namespace {

// All places and heights at which a tool may have to be.
ReachGrid grid_of(const scene::RobotCell& cell, double cell_m) {
  double low[3] = {9.0, 9.0, 9.0}, high[3] = {-9.0, -9.0, -9.0};
  const auto hold = [&](double x, double y, double z) {
    const double at[3] = {x, y, z};
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], at[k]);
      high[k] = std::max(high[k], at[k]);
    }
  };
  // As high as all that carry others can be put on each other.
  double piled_m = 0.0;
  for (const scene::Thing& each : cell.things)
    if (each.carries) piled_m += each.form.height_m;
  for (std::size_t k = 0; k < cell.things.size(); ++k) {
    const double above_m = cell.tool_above(static_cast<int>(k));
    const scene::Pose& start = cell.things[k].start;
    hold(start.x_m, start.y_m, start.z_m + above_m);
    hold(start.x_m, start.y_m, start.z_m + above_m + piled_m);
    for (const scene::Surface& each : cell.surfaces) {
      const double around_m = 0.5 * std::hypot(each.size_x_m, each.size_y_m);
      hold(each.middle.x_m - around_m, each.middle.y_m - around_m, each.middle.z_m + above_m);
      hold(each.middle.x_m + around_m, each.middle.y_m + around_m, each.middle.z_m + above_m + piled_m);
    }
  }
  ReachGrid grid;
  for (std::size_t k = 0; k < 3; ++k) {
    grid.origin_nm[k] = nanometres_of(low[k] - 0.001);
    grid.step_nm[k] = nanometres_of(cell_m);
    grid.cells[k] = std::max(1, static_cast<std::int32_t>(std::ceil((high[k] - low[k] + 0.002) / cell_m)));
  }
  return grid;
}

}  // namespace

IntervalModel::IntervalModel(const scene::RobotCell& cell, double cell_m) : things_(cell.things.size()) {
  const ReachGrid grid = grid_of(cell, cell_m);
  for (const scene::ArmModel& arm : cell.arms) {
    const auto reach = SrsReach::make(arm.chain);
    // The bounds are made for a base that stands upright.
    const bool upright = angle_between(arm.base.rotation, {}) < 1e-9;
    const motion::Vector3 base = arm.base.position_m;
    const Point3 at{nanometres_of(base.x), nanometres_of(base.y), nanometres_of(base.z)};
    reaches_.push_back(std::make_unique<const ReachTable>(ReachTable::fill(grid, [&](const Box& box) {
      if (!reach || !upright) return ArcSet::full();
      Box moved = box;
      for (std::size_t k = 0; k < 3; ++k) moved[k] = {box[k].low_nm - at[k], box[k].high_nm - at[k]};
      return reach->arcs_over(moved);
    })));
    auto exact = upright ? SrsExact::make(arm.chain, at) : std::nullopt;
    exacts_.push_back(exact ? std::make_unique<const SrsExact>(*std::move(exact)) : nullptr);
    cell_.arms.push_back({arm.name, reaches_.back().get(), exacts_.back().get()});
  }
  for (std::size_t k = 0; k < things_; ++k) {
    const scene::Thing& thing = cell.things[k];
    Grasp grasp;
    grasp.name = thing.name;
    grasp.height_m = cell.tool_above(static_cast<int>(k));
    cell_.grasps.push_back(grasp);
    cell_.objects.push_back({thing.name,
                             {thing.start.x_m, thing.start.y_m, thing.start.z_m, thing.start.angle_rad},
                             thing.form.height_m});
    turns_.push_back(thing.turns);
    angles_.push_back(thing.start.angle_rad);
  }
  for (const scene::Surface& surface : cell.surfaces)
    for (const scene::Thing& thing : cell.things) {
      const double across_m = 2.0 * radius_around(thing.form);
      cell_.regions.push_back({surface.name, surface.middle.x_m, surface.middle.y_m, surface.middle.z_m,
                               std::max(0.0, surface.size_x_m - across_m),
                               std::max(0.0, surface.size_y_m - across_m), surface.middle.angle_rad});
    }
}

Action IntervalModel::action_of(const scene::ActionSpec& action) const {
  const auto arm = static_cast<std::size_t>(action.arm), thing = static_cast<std::size_t>(action.thing);
  switch (action.kind) {
    case scene::ActionKind::Pick:
      return pick(arm, thing, thing);
    case scene::ActionKind::Place: {
      // What does not turn keeps its angle.
      const std::optional<double> angle = turns_[thing] ? std::nullopt : std::optional(angles_[thing]);
      if (action.on >= 0) return stack(arm, thing, static_cast<std::size_t>(action.on), angle);
      const std::size_t region = static_cast<std::size_t>(action.surface) * things_ + thing;
      return place(arm, thing, region, angle);
    }
    case scene::ActionKind::MoveAway:
      break;
  }
  return move_away(arm);
}

}  // namespace stepwright::tamp::planner

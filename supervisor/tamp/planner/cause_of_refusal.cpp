#include "supervisor/tamp/planner/cause_of_refusal.h"

#include <algorithm>

#include "supervisor/tamp/intervals/cause/cause.h"
#include "supervisor/tamp/scene/starts.h"

namespace stepwright::tamp::planner {

namespace {

// The cell with what was changed in its intervals. Angles of actions are no numbers of a cell: nothing.
std::optional<scene::RobotCell> changed_cell(const scene::RobotCell& cell, const WorkCell& changed,
                                             std::span<const Action> sequence) {
  scene::RobotCell other = cell;
  for (std::size_t k = 0; k < other.things.size(); ++k) {
    const ObjectPose& start = changed.objects[k].start;
    other.things[k].start = {start.x_m, start.y_m, start.z_m, start.angle_rad};
  }
  // Each surface is a region for each thing.
  for (std::size_t k = 0; k < other.surfaces.size(); ++k) {
    const Region& region = changed.regions[k * other.things.size()];
    other.surfaces[k].middle = {region.x_m, region.y_m, region.z_m, region.heading_rad};
  }
  for (const Action& each : sequence)
    if (each.final_angle_rad && *each.final_angle_rad != other.things[each.object].start.angle_rad)
      return std::nullopt;
  if (!scene::overlaps_of(other).empty()) return std::nullopt;
  return other;
}

}  // namespace

std::optional<std::string> cause_of_refusal(const scene::RobotCell& cell, const IntervalModel& model,
                                            std::span<const Action> refuted, const TampOptions& options,
                                            const Solvable& solvable) {
  // As much work as a plan of the whole takes where there is room; a cell that takes more is no proposal.
  TampOptions less = options;
  less.most_proposals = 0;
  less.most_failed = std::min<std::uint64_t>(less.most_failed, 20'000);
  less.most_path_motions = std::min<std::uint64_t>(less.most_path_motions, 400'000);
  less.most_skeletons = std::min<std::uint64_t>(less.most_skeletons, 200);
  std::size_t left = options.most_proposals;
  CauseOptions how;
  how.prove = left > 0;
  how.accepts = [&](const WorkCell& changed, std::span<const Action> sequence) {
    if (left == 0) return false;
    const auto other = changed_cell(cell, changed, sequence);
    if (!other) return false;
    --left;
    return solvable(*other, IntervalModel(*other), less);
  };
  auto cause = explain(model.cell(), refuted, how);
  if (!cause) return std::nullopt;
  return std::move(cause->sentence);
}

}  // namespace stepwright::tamp::planner

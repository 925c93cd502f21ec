#include "supervisor/fleet/envelope/internal/polygon_growth.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "supervisor/map/row_span.h"

namespace stepwright::fleet::internal {

namespace {

using geometry::ConvexPolygon;

// By how much the outline is enlarged, so that it is inside between poses too: along a chord of 0.2 m, which
// is what a corner moves in 0.1 m, an arc of 3 m radius bulges by less.
constexpr double kBulge_m = 0.002;
constexpr double kInside_m = 1e-7;
constexpr std::array<int, 3> kSides = {4, 8, 16};

}  // namespace

PolygonGrowth::PolygonGrowth(const OccupancyGrid& map, const geometry::Footprint& footprint,
                             std::span<const geometry::PathPose> path, const EnvelopeOptions& options)
    : map_(map), path_(path), options_(options) {
  const geometry::Footprint enlarged{footprint.front_m + kBulge_m, footprint.rear_m + kBulge_m,
                                     footprint.half_width_m + kBulge_m};
  for (const geometry::PathPose& pose : path) outlines_.push_back(footprint_at(pose.pose, enlarged));
}

std::optional<ConvexPolygon> PolygonGrowth::from(std::size_t pose) const {
  std::optional<Start> best;
  for (const int sides : kSides) {
    auto start = lay(sides, pose);
    if (start && (!best || start->last > best->last)) best = std::move(start);
    if (best && reaches_far(pose, best->last)) break;
  }
  if (best) return grow(std::move(best->sides), options_.growth_m);
  return hull_of_two(pose, after(pose));
}

std::optional<ConvexPolygon> PolygonGrowth::around(std::size_t stand, std::size_t neighbour) const {
  for (const int sides : kSides) {
    SidePolygon laid(sides, path_[stand].pose.heading_rad);
    laid.include(outlines_[stand]);
    laid.include(outlines_[neighbour]);
    if (free(laid.polygon())) return grow(std::move(laid), options_.stand_growth_m);
  }
  return hull_of_two(stand, neighbour);
}

Visit PolygonGrowth::visit(const ConvexPolygon& polygon, std::size_t pose, std::size_t earliest,
                           std::size_t latest) const {
  const auto inside = [&](std::size_t k) { return polygon.contains(outlines_[k], kInside_m); };
  Visit visit{pose, pose};
  while (visit.first_pose > earliest && inside(visit.first_pose - 1)) --visit.first_pose;
  while (visit.last_pose < latest && inside(visit.last_pose + 1)) ++visit.last_pose;
  visit.entry_m = path_[visit.first_pose].arc_m;
  visit.exit_m = path_[visit.last_pose].arc_m;
  return visit;
}

std::size_t PolygonGrowth::after(std::size_t pose) const {
  return std::min(pose + 1, path_.size() - 1);
}

// Along the vector from this pose to the next one, as the paper has it.
double PolygonGrowth::direction(std::size_t pose) const {
  const geometry::Point moved = path_[after(pose)].pose.position() - path_[pose].pose.position();
  return moved == geometry::Point{} ? path_[pose].pose.heading_rad : std::atan2(moved.y_m, moved.x_m);
}

bool PolygonGrowth::reaches_far(std::size_t pose, std::size_t last) const {
  return last + 1 == path_.size() || path_[last + 1].arc_m - path_[pose].arc_m > options_.stretch_m;
}

bool PolygonGrowth::free(const ConvexPolygon& polygon) const {
  return !meets_obstacle(map_, polygon);
}

// Around as many poses as fit; nothing if two do not. Each region holds the one before it, so that the
// first one that meets an obstacle is found by halving.
std::optional<PolygonGrowth::Start> PolygonGrowth::lay(int sides, std::size_t pose) const {
  SidePolygon laid(sides, direction(pose));
  laid.include(outlines_[pose]);
  laid.include(outlines_[after(pose)]);
  if (!free(laid.polygon())) return std::nullopt;
  std::vector<Start> starts = {{laid, after(pose)}};
  while (!reaches_far(pose, starts.back().last)) {
    laid.include(outlines_[starts.back().last + 1]);
    starts.push_back({laid, starts.back().last + 1});
  }
  const auto blocked =
      std::ranges::partition_point(starts, [&](const Start& start) { return free(start.sides.polygon()); });
  return *std::prev(blocked);
}

// Side by side in small steps. Where all sides can move at once, they could have one after the other.
ConvexPolygon PolygonGrowth::grow(SidePolygon sides, double growth_m) const {
  const int steps = static_cast<int>(std::floor(growth_m / options_.growth_step_m + 1e-9));
  std::vector<bool> stuck(sides.sides(), false);
  if (move_all(sides, stuck, steps * options_.growth_step_m)) return sides.polygon();
  for (int step = 0; step < steps; ++step) {
    if (move_all(sides, stuck, options_.growth_step_m)) continue;
    for (std::size_t side = 0; side < sides.sides(); ++side) {
      if (stuck[side]) continue;
      sides.move_side(side, options_.growth_step_m);
      stuck[side] = !free(sides.polygon());
      if (stuck[side]) sides.move_side(side, -options_.growth_step_m);
    }
  }
  return sides.polygon();
}

// All sides that are not stuck, or none.
bool PolygonGrowth::move_all(SidePolygon& sides, const std::vector<bool>& stuck, double by_m) const {
  SidePolygon moved = sides;
  for (std::size_t side = 0; side < sides.sides(); ++side) {
    if (!stuck[side]) moved.move_side(side, by_m);
  }
  if (!free(moved.polygon())) return false;
  sides = std::move(moved);
  return true;
}

std::optional<ConvexPolygon> PolygonGrowth::hull_of_two(std::size_t one, std::size_t other) const {
  std::vector<geometry::Point> corners;
  for (const std::size_t k : {one, other}) {
    corners.insert(corners.end(), outlines_[k].corners().begin(), outlines_[k].corners().end());
  }
  auto hull = ConvexPolygon::hull(corners);
  return hull && free(*hull) ? hull : std::nullopt;
}

}  // namespace stepwright::fleet::internal

#include "supervisor/fleet/envelope/grow_envelope.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "supervisor/fleet/envelope/internal/side_polygon.h"
#include "supervisor/fleet/map/row_span.h"

namespace stepwright::fleet {

namespace {

using geometry::ConvexPolygon;
using geometry::Path;
using internal::SidePolygon;

// By how much the outline is enlarged, so that it is inside between poses too: along a chord of 0.2 m, which
// is what a corner moves in 0.1 m, an arc of 3 m radius bulges by less.
constexpr double kBulge_m = 0.002;
constexpr double kInside_m = 1e-7;
constexpr std::array<int, 3> kSides = {4, 8, 16};

struct Start {
  SidePolygon sides;
  std::size_t last = 0;  // the last pose that was laid in
};

class Growth {
 public:
  Growth(const OccupancyGrid& map, const geometry::Footprint& footprint, const Path& path,
         const EnvelopeOptions& options)
      : map_(map), path_(path), options_(options) {
    const geometry::Footprint enlarged{footprint.front_m + kBulge_m, footprint.rear_m + kBulge_m,
                                       footprint.half_width_m + kBulge_m};
    for (const geometry::PathPose& pose : path) outlines_.push_back(footprint_at(pose.pose, enlarged));
  }

  // A polygon that holds the vehicle at `pose` and at the next one at least; nothing if an obstacle is
  // between.
  std::optional<ConvexPolygon> from(std::size_t pose) const {
    std::optional<Start> best;
    for (const int sides : kSides) {
      auto start = lay(sides, pose);
      if (start && (!best || start->last > best->last)) best = std::move(start);
      if (best && reaches_far(pose, best->last)) break;
    }
    if (best) return grow(std::move(best->sides));
    return hull_of_two(pose);
  }

  // The run of poses around `pose` at which the polygon holds the vehicle, from `earliest` on.
  Visit visit(const ConvexPolygon& polygon, std::size_t pose, std::size_t earliest) const {
    const auto inside = [&](std::size_t k) { return polygon.contains(outlines_[k], kInside_m); };
    Visit visit{pose, pose};
    while (visit.first_pose > earliest && inside(visit.first_pose - 1)) --visit.first_pose;
    while (visit.last_pose + 1 < path_.size() && inside(visit.last_pose + 1)) ++visit.last_pose;
    visit.entry_m = path_[visit.first_pose].arc_m;
    visit.exit_m = path_[visit.last_pose].arc_m;
    return visit;
  }

 private:
  std::size_t after(std::size_t pose) const { return std::min(pose + 1, path_.size() - 1); }

  // Along the vector from this pose to the next one, as the paper has it.
  double direction(std::size_t pose) const {
    const geometry::Point moved = path_[after(pose)].pose.position() - path_[pose].pose.position();
    return moved == geometry::Point{} ? path_[pose].pose.heading_rad : std::atan2(moved.y_m, moved.x_m);
  }

  bool reaches_far(std::size_t pose, std::size_t last) const {
    return last + 1 == path_.size() || path_[last + 1].arc_m - path_[pose].arc_m > options_.stretch_m;
  }

  bool free(const ConvexPolygon& polygon) const { return !meets_obstacle(map_, polygon); }

  // Around as many poses as fit; nothing if two do not. Each region holds the one before it, so that the
  // first one that meets an obstacle is found by halving.
  std::optional<Start> lay(int sides, std::size_t pose) const {
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
  ConvexPolygon grow(SidePolygon sides) const {
    const int steps = static_cast<int>(std::floor(options_.growth_m / options_.growth_step_m + 1e-9));
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
  bool move_all(SidePolygon& sides, const std::vector<bool>& stuck, double by_m) const {
    SidePolygon moved = sides;
    for (std::size_t side = 0; side < sides.sides(); ++side) {
      if (!stuck[side]) moved.move_side(side, by_m);
    }
    if (!free(moved.polygon())) return false;
    sides = std::move(moved);
    return true;
  }

  std::optional<ConvexPolygon> hull_of_two(std::size_t pose) const {
    std::vector<geometry::Point> corners;
    for (const std::size_t k : {pose, after(pose)}) {
      corners.insert(corners.end(), outlines_[k].corners().begin(), outlines_[k].corners().end());
    }
    auto hull = ConvexPolygon::hull(corners);
    return hull && free(*hull) ? hull : std::nullopt;
  }

  const OccupancyGrid& map_;
  const Path& path_;
  const EnvelopeOptions& options_;
  std::vector<ConvexPolygon> outlines_;
};

std::optional<std::string> wrong_path(const Path& path) {
  if (path.empty()) return "the path has no poses";
  for (std::size_t k = 0; k < path.size(); ++k) {
    const auto& [pose, arc_m, travel] = path[k];
    if (!std::isfinite(pose.x_m) || !std::isfinite(pose.y_m) || !std::isfinite(pose.heading_rad) ||
        !std::isfinite(arc_m)) {
      return fmt::format("pose {} of the path is not finite", k);
    }
    if (k > 0 && arc_m < path[k - 1].arc_m) return fmt::format("the way along the path falls at pose {}", k);
  }
  return std::nullopt;
}

std::optional<std::string> wrong_growth(const EnvelopeOptions& options) {
  constexpr double kMost_m = 1000.0;
  constexpr double kLeastStep_m = 0.001;
  const auto wrong = [&](const char* key, double value, double least) {
    return fmt::format("{} is {} m, outside {} to {}", key, value, least, kMost_m);
  };
  const auto within = [&](double value, double least) { return value >= least && value <= kMost_m; };
  if (!within(options.growth_m, 0.0)) return wrong("growth_m", options.growth_m, 0.0);
  if (!within(options.stretch_m, 0.0)) return wrong("stretch_m", options.stretch_m, 0.0);
  if (!within(options.growth_step_m, kLeastStep_m))
    return wrong("growth_step_m", options.growth_step_m, kLeastStep_m);
  return std::nullopt;
}

}  // namespace

void set_times(GrownEnvelope& grown, const SpeedLimits& speed) {
  auto& polygons = grown.envelope.polygons;
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    const Visit& visit = grown.visits[k];
    polygons[k].stay = time_bounds(visit.exit_m - visit.entry_m, speed);
    if (k + 1 < polygons.size()) {
      polygons[k].overlap = time_bounds(visit.exit_m - grown.visits[k + 1].entry_m, speed);
    }
  }
}

// A new polygon begins at the last pose that the one before holds, and holds the next pose too: the vehicle
// is never between two polygons, and each polygon takes it further.
result::Result<GrownEnvelope> grow_envelope(const OccupancyGrid& map, const geometry::Footprint& footprint,
                                            const std::string& vehicle, const Path& path,
                                            const EnvelopeOptions& options) {
  if (auto wrong = wrong_path(path)) return result::fail("F0501", {}, *std::move(wrong));
  if (auto wrong = wrong_growth(options)) return result::fail("F0504", {}, *std::move(wrong));
  if (auto wrong = check(options.speed, {}, ""); !wrong.empty()) return tl::unexpected(std::move(wrong));
  const Growth growth(map, footprint, path, options);
  GrownEnvelope grown;
  grown.envelope.vehicle = vehicle;
  std::size_t pose = 0;
  std::size_t earliest = 0;
  while (true) {
    auto polygon = growth.from(pose);
    if (!polygon) {
      const auto& at = path[pose].pose;
      return result::fail(
          "F0503", {},
          fmt::format("at pose {} of the path ({:.2f} m, {:.2f} m), or between it and the next, "
                      "the vehicle meets an obstacle or the border of the map",
                      pose, at.x_m, at.y_m));
    }
    const Visit visit = growth.visit(*polygon, pose, earliest);
    grown.envelope.polygons.push_back({*std::move(polygon), {}, {}});
    grown.visits.push_back(visit);
    if (visit.last_pose + 1 == path.size()) break;
    earliest = visit.first_pose;
    pose = visit.last_pose;
  }
  set_times(grown, options.speed);
  return grown;
}

}  // namespace stepwright::fleet

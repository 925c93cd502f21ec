#include "supervisor/fleet/envelope/grow_envelope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "supervisor/fleet/envelope/internal/polygon_growth.h"

namespace stepwright::fleet {

namespace {

using geometry::Path;
using internal::PolygonGrowth;

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
  if (!within(options.stand_growth_m, 0.0)) return wrong("stand_growth_m", options.stand_growth_m, 0.0);
  if (!within(options.stretch_m, 0.0)) return wrong("stretch_m", options.stretch_m, 0.0);
  if (!within(options.growth_step_m, kLeastStep_m))
    return wrong("growth_step_m", options.growth_step_m, kLeastStep_m);
  return std::nullopt;
}

std::optional<tl::unexpected<result::Diagnostics>> refusal(const Path& path, const EnvelopeOptions& options) {
  if (auto wrong = wrong_path(path)) return result::fail("F0501", {}, *std::move(wrong));
  if (auto wrong = wrong_growth(options)) return result::fail("F0504", {}, *std::move(wrong));
  if (auto wrong = check(options.speed, {}, ""); !wrong.empty()) return tl::unexpected(std::move(wrong));
  return std::nullopt;
}

tl::unexpected<result::Diagnostics> blocked(const Path& path, std::size_t pose) {
  const auto& at = path[pose].pose;
  return result::fail("F0503", {},
                      fmt::format("at pose {} of the path ({:.2f} m, {:.2f} m), or between it and the next, "
                                  "the vehicle meets an obstacle or the border of the map",
                                  pose, at.x_m, at.y_m));
}

// The way between two neighbouring stands of a path, and what is appended for it.
class Leg {
 public:
  Leg(const OccupancyGrid& map, const geometry::Footprint& footprint, std::span<const geometry::PathPose> way,
      const EnvelopeOptions& options, std::size_t begin)
      : growth_(map, footprint, way, options), last_(way.size() - 1), begin_(begin) {}

  // The pose of the way at which an obstacle is met; nothing if all is well.
  std::optional<std::size_t> grow(GrownEnvelope& grown) {
    auto goal = growth_.around(last_, last_ == 0 ? 0 : last_ - 1);
    if (!goal) return last_ == 0 ? 0 : last_ - 1;
    if (last_ == 0) {
      const Visit only = growth_.visit(*goal, 0, 0, 0);
      append(*std::move(goal), only, grown);
      return std::nullopt;
    }
    const Visit arrival = growth_.visit(*goal, last_, 0, last_);
    auto start = growth_.around(0, 1);
    if (!start) return 0;
    Visit visit = growth_.visit(*start, 0, 0, arrival.first_pose);
    append(*std::move(start), visit, grown);
    while (visit.last_pose < arrival.first_pose) {
      auto polygon = growth_.from(visit.last_pose);
      if (!polygon) return visit.last_pose;
      visit = growth_.visit(*polygon, visit.last_pose, visit.first_pose, arrival.first_pose);
      append(*std::move(polygon), visit, grown);
    }
    append(*std::move(goal), arrival, grown);
    return std::nullopt;
  }

 private:
  void append(geometry::ConvexPolygon polygon, Visit visit, GrownEnvelope& grown) const {
    visit.first_pose += begin_;
    visit.last_pose += begin_;
    grown.envelope.polygons.push_back({std::move(polygon), {}, {}});
    grown.visits.push_back(visit);
  }

  PolygonGrowth growth_;
  std::size_t last_;
  std::size_t begin_;
};

bool in_order(std::span<const Stand> stands, std::size_t poses) {
  std::size_t least = 0;
  for (const Stand& stand : stands) {
    if (stand.pose < least || stand.pose >= poses || stand.service.count() < 0) return false;
    least = stand.pose;
  }
  return true;
}

}  // namespace

void set_times(GrownEnvelope& grown, const SpeedLimits& speed) {
  auto& polygons = grown.envelope.polygons;
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    const Visit& visit = grown.visits[k];
    polygons[k].stay = time_bounds(visit.exit_m - visit.entry_m, speed);
    polygons[k].stay.least = std::min(polygons[k].stay.least + visit.service, speed.horizon);
    polygons[k].stay.most = std::min(polygons[k].stay.most + visit.service, speed.horizon);
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
  if (auto refused = refusal(path, options)) return *std::move(refused);
  const PolygonGrowth growth(map, footprint, path, options);
  GrownEnvelope grown;
  grown.envelope.vehicle = vehicle;
  std::size_t pose = 0;
  std::size_t earliest = 0;
  while (true) {
    auto polygon = growth.from(pose);
    if (!polygon) return blocked(path, pose);
    const Visit visit = growth.visit(*polygon, pose, earliest, path.size() - 1);
    grown.envelope.polygons.push_back({*std::move(polygon), {}, {}});
    grown.visits.push_back(visit);
    if (visit.last_pose + 1 == path.size()) break;
    earliest = visit.first_pose;
    pose = visit.last_pose;
  }
  set_times(grown, options.speed);
  return grown;
}

result::Result<GrownEnvelope> grow_in_parts(const OccupancyGrid& map, const geometry::Footprint& footprint,
                                            const std::string& vehicle, const Path& path,
                                            std::span<const EnvelopePart> parts) {
  assert(!parts.empty() && parts.back().last_pose + 1 == path.size());
  GrownEnvelope grown;
  grown.envelope.vehicle = vehicle;
  std::size_t begin = 0;
  for (const EnvelopePart& part : parts) {
    const auto first = path.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto end = path.begin() + static_cast<std::ptrdiff_t>(part.last_pose) + 1;
    auto more = grow_envelope(map, footprint, vehicle, Path(first, end), part.options);
    if (!more) return more;
    for (std::size_t k = 0; k < more->visits.size(); ++k) {
      grown.envelope.polygons.push_back(std::move(more->envelope.polygons[k]));
      grown.visits.push_back(more->visits[k]);
      grown.visits.back().first_pose += begin;
      grown.visits.back().last_pose += begin;
    }
    begin = part.last_pose;
  }
  set_times(grown, parts.front().options.speed);
  return grown;
}

// Between two stands: a small polygon around the first, then polygons as above, each from the last pose that
// the one before holds, up to the first pose that the small polygon around the second stand holds.
result::Result<GrownEnvelope> grow_between_stands(const OccupancyGrid& map,
                                                  const geometry::Footprint& footprint,
                                                  const std::string& vehicle, const Path& path,
                                                  std::span<const Stand> stands,
                                                  const EnvelopeOptions& options) {
  if (auto refused = refusal(path, options)) return *std::move(refused);
  if (!in_order(stands, path.size())) {
    return result::fail("F0505", {}, "a stand is not on the path, or before the one that precedes it");
  }
  std::vector<Stand> all(stands.begin(), stands.end());
  if (all.empty() || all.back().pose + 1 < path.size()) all.push_back({path.size() - 1});
  GrownEnvelope grown;
  grown.envelope.vehicle = vehicle;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    // Who only begins there needs no polygon for it.
    const bool nothing = k == 0 && all.size() > 1 && all[k].pose == 0 && all[k].service.count() == 0;
    if (nothing) {
      grown.stands.push_back(0);
      continue;
    }
    const auto way = std::span(path).subspan(begin, all[k].pose - begin + 1);
    Leg leg(map, footprint, way, options, begin);
    if (const auto met = leg.grow(grown)) return blocked(path, begin + *met);
    grown.visits.back().service = all[k].service;
    grown.stands.push_back(grown.visits.size() - 1);
    begin = all[k].pose;
  }
  grown.stands.resize(stands.size());
  set_times(grown, options.speed);
  return grown;
}

}  // namespace stepwright::fleet

#include "supervisor/tamp/mission/sight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace stepwright::tamp::mission {
namespace {

constexpr std::array<std::string_view, 4> kKinds = {"cup", "can", "tray", "box"};
constexpr double kSame_m = 0.02;    // reports of one thing
constexpr double kLevel_m = 0.015;  // of a surface

struct Cluster {
  int kind = 0;
  std::vector<scene::Pose> poses;
  std::size_t first = 0, last = 0;  // reports that have it
  bool in_newest = false;           // both of them

  scene::Pose mean() const {
    scene::Pose sum;
    double along = 0.0, across = 0.0;
    for (const scene::Pose& each : poses) {
      sum.x_m += each.x_m;
      sum.y_m += each.y_m;
      sum.z_m += each.z_m;
      along += std::cos(each.angle_rad);
      across += std::sin(each.angle_rad);
    }
    const auto count = static_cast<double>(poses.size());
    return {sum.x_m / count, sum.y_m / count, sum.z_m / count, std::atan2(across, along)};
  }
};

double far(const scene::Pose& a, const scene::Pose& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m, a.z_m - b.z_m);
}

// Of a thing that was moved while it was looked at: what the two newest reports have in its place.
bool took_place_of(const Cluster& now, const Cluster& before) {
  return now.kind == before.kind && now.in_newest && now.first > before.last;
}

bool is_near(const Cluster& cluster, const std::vector<scene::Pose>& poses) {
  return std::ranges::any_of(poses,
                             [&](const scene::Pose& pose) { return far(cluster.mean(), pose) < kSame_m; });
}

// More than half of the reports have it; or two, where a thing was believed to be. None where something was
// and is no more, as it has come to where nothing was believed to be: of what is only not seen for a while,
// others that are seen again say nothing.
std::vector<Cluster> clusters_of(const std::vector<Report>& reports, const std::vector<scene::Pose>& before) {
  std::vector<Cluster> clusters;
  for (std::size_t number = 0; number < reports.size(); ++number)
    for (const Seen& each : reports[number]) {
      const auto same = [&](const Cluster& cluster) {
        return cluster.kind == each.kind && far(cluster.poses.front(), each.pose) < kSame_m;
      };
      auto found = std::ranges::find_if(clusters, same);
      if (found == clusters.end()) found = clusters.insert(found, {each.kind, {}, number, number});
      found->in_newest = found->in_newest || (number + 1 == reports.size() && found->last + 1 == number);
      found->last = number;
      found->poses.push_back(each.pose);
    }
  const std::vector<Cluster> all = clusters;
  std::erase_if(clusters, [&](const Cluster& each) {
    return std::ranges::any_of(
        all, [&](const Cluster& other) { return took_place_of(other, each) && !is_near(other, before); });
  });
  std::erase_if(clusters, [&](const Cluster& each) {
    return 2 * each.poses.size() <= reports.size() && (each.poses.size() < 2 || !is_near(each, before));
  });
  return clusters;
}

}  // namespace

int kind_of(const scene::Thing& thing) {
  const auto found = std::ranges::find(kKinds, thing.kind);
  return found == kKinds.end() ? 0 : static_cast<int>(found - kKinds.begin()) + 1;
}

Sight agree(const scene::RobotCell& cell, const std::vector<Report>& reports,
            const std::vector<scene::Pose>& before) {
  Sight sight;
  sight.things.resize(cell.things.size());
  std::vector<Cluster> clusters = clusters_of(reports, before);
  // The nearest pair of all first.
  while (true) {
    double nearest_m = 1e9;
    std::size_t thing = 0, cluster = 0;
    for (std::size_t k = 0; k < cell.things.size(); ++k) {
      if (sight.things[k]) continue;
      for (std::size_t c = 0; c < clusters.size(); ++c) {
        if (clusters[c].kind != kind_of(cell.things[k])) continue;
        const double far_m = far(clusters[c].mean(), before[k]);
        if (far_m >= nearest_m) continue;
        nearest_m = far_m;
        thing = k;
        cluster = c;
      }
    }
    if (nearest_m >= 1e9) break;
    sight.things[thing] = clusters[cluster].mean();
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(cluster));
  }
  for (const Cluster& each : clusters) sight.strangers.push_back({each.kind, each.mean()});
  return sight;
}

scene::Pose settled(const scene::RobotCell& cell, const Sight& sight, std::size_t thing,
                    const scene::Pose& seen) {
  std::vector<double> levels = {0.0};
  const auto add = [&](const scene::Form& form, const scene::Pose& pose) {
    const scene::Upright body = standing(form, pose);
    const scene::Upright foot = standing({.round = true, .radius_m = 1e-6, .height_m = 1.0}, seen);
    if (gap(body, foot) < 0.005) levels.push_back(body.high_m);
  };
  for (const scene::Furniture& each : cell.furniture) add(each.form, each.pose);
  for (std::size_t k = 0; k < cell.things.size(); ++k)
    if (k != thing && sight.things[k] && cell.things[k].carries) {
      scene::Pose below = *sight.things[k];
      // Of piles of more than two the heights add up.
      if (below.z_m + 0.5 * cell.things[k].form.height_m < seen.z_m) {
        below = settled(cell, sight, k, below);
        add(cell.things[k].form, below);
      }
    }
  for (const scene::Surface& each : cell.surfaces)
    if (lies_within(each, {.round = true, .radius_m = 0.0, .height_m = 1.0}, seen, 0.005))
      levels.push_back(each.middle.z_m);
  scene::Pose pose = seen;
  double nearest_m = kLevel_m;
  for (const double each : levels)
    if (std::abs(each - seen.z_m) < nearest_m) {
      nearest_m = std::abs(each - seen.z_m);
      pose.z_m = each;
    }
  return pose;
}

}  // namespace stepwright::tamp::mission

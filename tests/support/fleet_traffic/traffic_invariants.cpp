#include "tests/support/fleet_traffic/traffic_invariants.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace stepwright::support {

namespace {

using fleet::Route;
using fleet::Traffic;

constexpr double kRounding_m = 1e-6;

// Permissions still to be given, as a graph: which one must be given before which other one. Polygons that
// are needed together are permitted together.
class Permissions {
 public:
  explicit Permissions(const Traffic& traffic) : traffic_(traffic) {
    for (std::uint32_t v = 0; v < traffic.vehicles(); ++v)
      seen_.emplace_back(traffic.route(v).polygons(), Seen::No);
  }

  std::string circle() {
    for (std::uint32_t v = 0; v < traffic_.vehicles(); ++v) {
      if (traffic_.removed(v)) continue;
      for (std::uint32_t k = traffic_.granted(v); k < traffic_.route(v).polygons(); ++k)
        if (!visit(v, k)) return circle_;
    }
    return {};
  }

 private:
  enum class Seen : std::uint8_t { No, Underway, Done };

  // The last polygon that is permitted together with this one.
  std::uint32_t group_end(std::uint32_t vehicle, std::uint32_t polygon) const {
    const auto& needed_m = traffic_.route(vehicle).needed_m;
    while (polygon + 1 < needed_m.size() && needed_m[polygon + 1] == needed_m[polygon]) ++polygon;
    return polygon;
  }

  // The last one that must be permitted for the vehicle to come to where it has left `polygon`.
  std::uint32_t permitted_for_leaving(std::uint32_t vehicle, std::uint32_t polygon) const {
    const Route& route = traffic_.route(vehicle);
    std::uint32_t last = polygon + 1;
    const double to_m = route.left_m[polygon] + fleet::kHalt_m - kRounding_m;
    while (last + 1 < route.polygons() && route.needed_m[last + 1] < to_m) ++last;
    return last;
  }

  // False if a circle was found.
  bool visit(std::uint32_t vehicle, std::uint32_t polygon) {
    if (polygon < traffic_.granted(vehicle)) return true;
    const std::uint32_t end = group_end(vehicle, polygon);
    Seen& seen = seen_[vehicle][end];
    if (seen == Seen::Done) return true;
    const std::string name = fmt::format("v{}[{}]", vehicle + 1, end);
    if (seen == Seen::Underway) {
      circle_ = name + " waits for itself";
      return false;
    }
    seen = Seen::Underway;
    const auto& needed_m = traffic_.route(vehicle).needed_m;
    while (polygon > 0 && needed_m[polygon - 1] == needed_m[end]) --polygon;
    bool fine = polygon == 0 || visit(vehicle, polygon - 1);
    for (const auto& wait : traffic_.waits(vehicle)) {
      if (!fine) break;
      if (group_end(vehicle, wait.polygon) != end || traffic_.removed(wait.vehicle)) continue;
      if (traffic_.first(wait.vehicle) > wait.left) continue;
      if (wait.left + 1 >= traffic_.route(wait.vehicle).polygons()) {
        circle_ = fmt::format("v{} rests where others have to go", wait.vehicle + 1);
        return false;
      }
      fine = visit(wait.vehicle, permitted_for_leaving(wait.vehicle, wait.left));
    }
    if (!fine) circle_ = name + " <- " + circle_;
    seen_[vehicle][end] = Seen::Done;
    return fine;
  }

  const Traffic& traffic_;
  std::vector<std::vector<Seen>> seen_;  // by vehicle and polygon
  std::string circle_;
};

}  // namespace

std::string waits_in_two_polygons(const Route& route, std::uint32_t first) {
  double left_m = route.mission.path.front().arc_m;  // all polygons but the last one before k
  for (std::uint32_t k = first + 1; k < route.polygons(); ++k) {
    if (route.needed_m[k] < route.needed_m[k - 1])
      return fmt::format("polygon {} is needed before the one before it", k);
    const bool waits_here = route.needed_m[k] > route.needed_m[k - 1];
    if (waits_here && k >= first + 2 && left_m > route.needed_m[k] - fleet::kHalt_m + kRounding_m)
      return fmt::format("who waits before polygon {} has not left all polygons before {}", k, k - 1);
    left_m = std::max(left_m, route.left_m[k - 1]);
  }
  return {};
}

std::string broken_invariant(const Traffic& traffic) {
  for (std::uint32_t v = 0; v < traffic.vehicles(); ++v) {
    if (traffic.removed(v)) continue;
    if (std::string wrong = waits_in_two_polygons(traffic.route(v), traffic.first(v)); !wrong.empty())
      return fmt::format("v{}: {}", v + 1, wrong);
  }
  return Permissions(traffic).circle();
}

}  // namespace stepwright::support

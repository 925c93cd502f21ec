#include "supervisor/ltl/guide/corridor.h"

#include <algorithm>

#include "supervisor/geometry/outline.h"

namespace stepwright::ltl {

using geometry::Point;

namespace {

constexpr int kRounds = 8;  // of moving the end to where the way comes from

// Positive where c lies to the left of the way from a to b.
double turn(Point a, Point b, Point c) {
  return cross(b - a, c - a);
}

}  // namespace

Corridor::Corridor(const RegionMap& map) : map_(map), at_wall_(map.points().size(), false) {
  for (const Region& region : map.regions()) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (region.across[k] != kNoRegion) continue;
      at_wall_[region.corners[k]] = true;
      at_wall_[region.corners[(k + 1) % 3]] = true;
    }
  }
}

Corridor::Gate Corridor::gate(std::uint32_t from, std::uint32_t to, double margin_m) const {
  const Region& region = map_.region(from);
  const auto side = static_cast<std::size_t>(std::ranges::find(region.across, to) - region.across.begin());
  // Corners are in anticlockwise order, so who leaves has the second one to the left.
  const std::uint32_t left = region.corners[(side + 1) % 3], right = region.corners[side];
  Gate gate{map_.points()[left], map_.points()[right]};
  const Point across = gate.right - gate.left;
  const double wide_m = geometry::distance(gate.left, gate.right);
  const double left_m = at_wall_[left] ? margin_m : 0.0;
  const double right_m = at_wall_[right] ? margin_m : 0.0;
  if (left_m + right_m >= wide_m) {
    const double share = left_m / (left_m + right_m);
    gate.left = gate.left + share * across;
    gate.right = gate.left;
    return gate;
  }
  const Point left_end = gate.left;
  gate.left = left_end + (left_m / wide_m) * across;
  gate.right = left_end + (1.0 - right_m / wide_m) * across;
  return gate;
}

namespace {

// Both walls of the funnel from its apex on; where one of them turns over the other, the apex moves there.
template <typename Gates>
std::vector<Point> pulled(const Gates& gates, Point from, Point to) {
  std::vector<Point> way = {from};
  Point apex = from, left = from, right = from;
  std::size_t left_at = 0, right_at = 0;
  for (std::size_t k = 0; k <= gates.size(); ++k) {
    const Point next_left = k < gates.size() ? gates[k].left : to;
    const Point next_right = k < gates.size() ? gates[k].right : to;
    if (turn(apex, right, next_right) >= 0.0) {
      if (apex == right || turn(apex, left, next_right) <= 0.0) {
        right = next_right;
        right_at = k;
      } else {
        apex = left;
        way.push_back(apex);
        k = left_at;
        left = right = apex;
        right_at = left_at;
        continue;
      }
    }
    if (turn(apex, left, next_left) <= 0.0) {
      if (apex == left || turn(apex, right, next_left) >= 0.0) {
        left = next_left;
        left_at = k;
      } else {
        apex = right;
        way.push_back(apex);
        k = right_at;
        left = right = apex;
        left_at = right_at;
        continue;
      }
    }
  }
  if (!(way.back() == to)) way.push_back(to);
  const auto repeated = std::ranges::unique(way);
  way.erase(repeated.begin(), repeated.end());
  return way;
}

}  // namespace

std::vector<Point> Corridor::way(std::span<const Stage> stages, Point from, double margin_m) const {
  std::vector<Gate> gates;
  for (std::size_t k = 0; k + 1 < stages.size(); ++k)
    gates.push_back(gate(stages[k].region, stages[k + 1].region, margin_m));
  if (gates.empty()) return {from};
  // The end moves along the last gate towards where the way comes from, until that is a corner that stays.
  const Gate last = gates.back();
  gates.pop_back();
  Point end = nearest_on_side(last.left, last.right, from);
  std::vector<Point> way;
  for (int round = 0; round < kRounds; ++round) {
    way = pulled(gates, from, end);
    const Point before = way.size() > 1 ? way[way.size() - 2] : from;
    const Point better = nearest_on_side(last.left, last.right, before);
    if (geometry::distance(better, end) < 1e-12) break;
    end = better;
  }
  return way;
}

double length_m(std::span<const Point> way) {
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < way.size(); ++k) length += geometry::distance(way[k], way[k + 1]);
  return length;
}

}  // namespace stepwright::ltl

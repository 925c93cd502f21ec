#include "supervisor/fleet/lattice/obstacle_distances.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "supervisor/fleet/lattice/internal/cost_buckets.h"

namespace stepwright::fleet {

namespace {

constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kExact = 65536;
constexpr double kRounding_m = 1e-4;                 // of distances in single precision
constexpr std::size_t kVerticesBetweenLooks = 4096;  // whether it is cancelled
constexpr double kBeyondStart_m = 10.0;              // how much farther than the start vertices are looked at

// The vectors of all headings: along each of them a chain is as long as a straight line.
constexpr std::array<GridVector, kHeadings> all_steps() {
  std::array<GridVector, kHeadings> steps;
  for (int heading = 0; heading < kHeadings; ++heading) {
    steps[static_cast<std::size_t>(heading)] = heading_vector(heading);
  }
  return steps;
}
constexpr std::array<GridVector, kHeadings> kSteps = all_steps();

// Rounded down, so that a chain never seems longer than it is.
std::uint32_t step_mm(GridVector step, double resolution_m) {
  return static_cast<std::uint32_t>(1000.0 * resolution_m * std::hypot(step.x, step.y) + 1e-6);
}

using Vertices = std::map<std::pair<std::int32_t, std::int32_t>, std::uint32_t>;

// All vertices within kDetour of the track.
Vertices near_track(const MotionPrimitive& primitive, double resolution_m) {
  Vertices vertices;
  const int samples = static_cast<int>(primitive.length_m / 0.005) + 1;
  for (int k = 0; k <= samples; ++k) {
    const geometry::Pose pose = pose_along(primitive, primitive.length_m * k / samples);
    const double x = pose.x_m / resolution_m;
    const double y = pose.y_m / resolution_m;
    for (auto column = static_cast<std::int32_t>(std::floor(x)); column <= std::ceil(x); ++column) {
      for (auto row = static_cast<std::int32_t>(std::floor(y)); row <= std::ceil(y); ++row) {
        if (std::hypot(column - x, row - y) < kDetour) vertices[{column, row}] = kNever;
      }
    }
  }
  return vertices;
}

std::uint32_t cheapest_chain(const MotionPrimitive& primitive, double resolution_m) {
  Vertices costs = near_track(primitive, resolution_m);
  using Entry = std::pair<std::uint32_t, std::pair<std::int32_t, std::int32_t>>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  costs[{0, 0}] = 0;
  open.push({0, {0, 0}});
  while (!open.empty()) {
    const auto [cost, at] = open.top();
    open.pop();
    if (cost != costs[at]) continue;
    for (const GridVector step : kSteps) {
      const auto next = costs.find({at.first + step.x, at.second + step.y});
      const std::uint32_t through = cost + step_mm(step, resolution_m);
      if (next == costs.end() || through >= next->second) continue;
      next->second = through;
      open.push({through, next->first});
    }
  }
  const std::uint32_t chain = costs.at({primitive.end.x, primitive.end.y});
  assert(chain != kNever);
  return chain;
}

template <typename Millimetres>
std::uint32_t largest_detour(const PrimitiveSet& primitives, const Millimetres& of) {
  std::uint64_t detour = 0;
  for (const MotionPrimitive& primitive : primitives.all()) {
    const std::uint64_t chain = cheapest_chain(primitive, primitives.options().resolution_m);
    detour = std::max(detour, ((chain << 16) + of(primitive) - 1) / of(primitive));
  }
  return static_cast<std::uint32_t>(detour);
}

}  // namespace

std::uint32_t detour_of(const PrimitiveSet& primitives) {
  return largest_detour(primitives, [](const MotionPrimitive& p) { return p.cost_mm; });
}

std::uint32_t length_detour_of(const PrimitiveSet& primitives) {
  return largest_detour(primitives, [](const MotionPrimitive& p) {
    return static_cast<std::uint32_t>(1000.0 * p.length_m);  // rounded down
  });
}

// Dijkstra's algorithm from the goal, until all that is kBeyondStart_m farther than the start is known.
ObstacleDistances::ObstacleDistances(const DistanceField& clearance, const ObstacleQuestion& question)
    : columns_(question.columns),
      unreachable_(true),
      bounds_(static_cast<std::size_t>(question.columns) * static_cast<std::size_t>(question.rows), kNever) {
  const double least_m = question.inscribed_radius_m - kDetour * question.resolution_m - kRounding_m;
  const auto within = [&](GridVector at) {
    return at.x >= 0 && at.y >= 0 && at.x < question.columns && at.y < question.rows;
  };
  const auto passable = [&](GridVector at) {
    return clearance.at_corner({at.x * question.cells_per_step, at.y * question.cells_per_step}) >= least_m;
  };
  std::array<std::uint32_t, kSteps.size()> steps{};
  std::ranges::transform(kSteps, steps.begin(),
                         [&](GridVector s) { return step_mm(s, question.resolution_m); });
  internal::CostBuckets buckets(std::ranges::max(steps));
  bounds_[index(question.goal)] = 0;
  buckets.push(0, static_cast<std::uint32_t>(index(question.goal)));
  std::uint32_t last = 0;
  std::uint64_t limit = kNever;
  std::size_t looked_at = 0;
  for (auto next = buckets.pop(); next && last <= limit; next = buckets.pop()) {
    const auto [distance, state] = *next;
    if (bounds_[state] != distance) continue;
    if (question.cancel != nullptr && ++looked_at % kVerticesBetweenLooks == 0 && question.cancel->load()) {
      cancelled_ = true;
      unreachable_ = false;
      last = 0;
      break;
    }
    last = distance;
    const auto vertex = static_cast<std::int32_t>(state);
    const GridVector at{vertex % columns_, vertex / columns_};
    if (at == question.start) {
      unreachable_ = false;
      limit = distance + static_cast<std::uint64_t>(1000.0 * kBeyondStart_m);
    }
    for (std::size_t k = 0; k < kSteps.size(); ++k) {
      const GridVector to = at + kSteps[k];
      if (!within(to)) continue;
      std::uint32_t& known = bounds_[index(to)];
      if (distance + steps[k] >= known || !passable(to)) continue;
      known = distance + steps[k];
      buckets.push(known, static_cast<std::uint32_t>(index(to)));
    }
  }
  finish(last, question.detour);
}

// What was offered but not looked at may still come down to `last`; no vertex comes below.
void ObstacleDistances::finish(std::uint32_t last, std::uint32_t detour) {
  for (std::uint32_t& bound : bounds_) {
    bound = std::min(bound, last);
    if (detour != kExact) bound = static_cast<std::uint32_t>((std::uint64_t{bound} << 16) / detour);
  }
}

}  // namespace stepwright::fleet

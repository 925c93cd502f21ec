#include "tests/bench/lattice/plain_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <unordered_map>
#include <vector>

#include "supervisor/map/row_span.h"

namespace stepwright::bench {

namespace {

using namespace stepwright::fleet;

struct State {
  GridVector vertex;
  int heading = 0;

  friend bool operator==(const State&, const State&) = default;
};

struct StateHash {
  std::size_t operator()(const State& state) const {
    const auto x = static_cast<std::uint64_t>(state.vertex.x);
    const auto y = static_cast<std::uint64_t>(state.vertex.y);
    return static_cast<std::size_t>(
        ((x << 24) ^ (y << 4) ^ static_cast<std::uint64_t>(state.heading)) * 0x9e3779b97f4a7c15u >> 16);
  }
};

struct Entry {
  std::uint32_t key;
  std::uint32_t cost;
  State state;

  friend bool operator<(const Entry& a, const Entry& b) {
    return a.key != b.key ? a.key > b.key : a.cost < b.cost;
  }
};

class PlainSearch {
 public:
  PlainSearch(const OccupancyGrid& grid, const VehicleModel& vehicle, const PrimitiveSet& primitives,
              const geometry::Pose& start, const geometry::Pose& goal)
      : grid_(grid),
        vehicle_(vehicle),
        primitives_(primitives),
        clearance_(grid),
        start_(place(start)),
        goal_(place(goal)),
        around_(clearance_, {.goal = goal_.vertex,
                             .start = start_.vertex,
                             .columns = grid.frame().columns + 1,
                             .rows = grid.frame().rows + 1,
                             .cells_per_step = 1,
                             .resolution_m = grid.frame().resolution_m,
                             .inscribed_radius_m = vehicle.inscribed_radius_m(),
                             .detour = detour_of(primitives)}) {}

  PlainResult run() {
    offer(start_, 0);
    PlainResult result;
    while (!open_.empty()) {
      const Entry entry = open_.top();
      open_.pop();
      if (costs_.at(entry.state) != entry.cost) continue;
      if (entry.state == goal_) return {true, entry.cost, result.expanded};
      ++result.expanded;
      for (const MotionPrimitive& primitive : primitives_.from(entry.state.heading)) {
        const State to{entry.state.vertex + primitive.end, primitive.end_heading};
        const std::uint32_t cost = entry.cost + primitive.cost_mm;
        const auto known = costs_.find(to);
        if (known != costs_.end() && known->second <= cost) continue;
        if (free(entry.state, primitive)) offer(to, cost);
      }
    }
    return result;
  }

 private:
  State place(const geometry::Pose& pose) const {
    const double step_m = grid_.frame().resolution_m;
    return {{static_cast<std::int32_t>(std::lround((pose.x_m - grid_.frame().origin.x_m) / step_m)),
             static_cast<std::int32_t>(std::lround((pose.y_m - grid_.frame().origin.y_m) / step_m))},
            nearest_heading(pose.heading_rad)};
  }

  bool free(const State& from, const MotionPrimitive& primitive) const {
    const geometry::Point vertex = grid_.frame().corner({from.vertex.x, from.vertex.y});
    const int steps = static_cast<int>(std::ceil(primitive.length_m / 0.1));
    for (int k = 1; k <= steps; ++k) {
      geometry::Pose pose = pose_along(primitive, primitive.length_m * k / steps);
      pose.x_m += vertex.x_m;
      pose.y_m += vertex.y_m;
      if (!stands(pose)) return false;
    }
    return true;
  }

  // The outline only where the distance to obstacles does not decide: what Nav2's planners do.
  bool stands(const geometry::Pose& pose) const {
    const Cell cell = grid_.frame().cell_at(pose.position());
    if (!grid_.contains(cell)) return false;
    const double clearance_m = clearance_.at_corner(cell);
    const double to_corner_m = std::numbers::sqrt2 * grid_.frame().resolution_m;
    if (clearance_m - to_corner_m > vehicle_.circumscribed_radius_m()) return true;
    if (clearance_m + to_corner_m < vehicle_.inscribed_radius_m()) return false;
    return !meets_obstacle(grid_, footprint_at(pose, vehicle_.footprint()));
  }

  void offer(const State& state, std::uint32_t cost) {
    costs_[state] = cost;
    const GridVector offset = state.vertex - goal_.vertex;
    const double euclid_mm = 1000.0 * grid_.frame().resolution_m * std::hypot(offset.x, offset.y);
    const std::uint32_t estimate =
        std::max(static_cast<std::uint32_t>(euclid_mm), around_.lower_bound_mm(state.vertex));
    open_.push({cost + estimate, cost, state});
  }

  const OccupancyGrid& grid_;
  const VehicleModel& vehicle_;
  const PrimitiveSet& primitives_;
  DistanceField clearance_;
  State start_;
  State goal_;
  ObstacleDistances around_;
  std::unordered_map<State, std::uint32_t, StateHash> costs_;
  std::priority_queue<Entry> open_;
};

}  // namespace

PlainResult plain_search(const OccupancyGrid& grid, const VehicleModel& vehicle,
                         const PrimitiveSet& primitives, const geometry::Pose& start,
                         const geometry::Pose& goal) {
  return PlainSearch(grid, vehicle, primitives, start, goal).run();
}

}  // namespace stepwright::bench

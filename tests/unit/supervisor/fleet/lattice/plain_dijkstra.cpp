#include "tests/unit/supervisor/fleet/lattice/plain_dijkstra.h"

#include <queue>
#include <utility>
#include <vector>

namespace stepwright::fleet {

bool plain_free(const PlainFloor& floor, const PlainPose& pose, std::size_t primitive) {
  if (floor.grid == nullptr) return true;
  const auto [x, y, heading] = pose;
  const int scale = floor.cells->cells_per_step();
  for (const RowSpan& span : floor.cells->of_primitive(primitive).spans) {
    for (std::int32_t column = span.first; column <= span.last; ++column) {
      if (floor.grid->blocked({x * scale + column, y * scale + span.row})) return false;
    }
  }
  return true;
}

PlainCosts plain_costs(const PlainFloor& floor, const PlainPose& start, std::uint32_t most,
                       std::optional<PlainPose> goal) {
  PlainCosts settled;
  using Entry = std::pair<std::uint32_t, PlainPose>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.push({0, start});
  while (!open.empty() && open.top().first <= most) {
    const auto [cost, pose] = open.top();
    open.pop();
    if (!settled.emplace(pose, cost).second) continue;
    if (goal == pose) break;
    const auto [x, y, heading] = pose;
    for (std::size_t k = 0; k < PrimitiveSet::kPerHeading; ++k) {
      const std::size_t index = static_cast<std::size_t>(heading) * PrimitiveSet::kPerHeading + k;
      const MotionPrimitive& primitive = floor.primitives.all()[index];
      const PlainPose to{x + primitive.end.x, y + primitive.end.y, primitive.end_heading};
      if (!settled.contains(to) && plain_free(floor, pose, index)) open.push({cost + primitive.cost_mm, to});
    }
  }
  return settled;
}

}  // namespace stepwright::fleet

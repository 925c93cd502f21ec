#include "supervisor/fleet/lattice/reachable.h"

#include <queue>
#include <tuple>
#include <unordered_set>
#include <vector>

#include "supervisor/fleet/lattice/heading.h"

namespace stepwright::fleet {

namespace {

struct Open {
  std::uint32_t cost_mm = 0;
  GridVector vertex;
  int heading = 0;

  bool operator>(const Open& other) const {
    return std::tuple(cost_mm, vertex.x, vertex.y, heading) >
           std::tuple(other.cost_mm, other.vertex.x, other.vertex.y, other.heading);
  }
};

std::uint64_t key_of(const Open& at) {
  return std::uint64_t{static_cast<std::uint32_t>(at.vertex.x)} << 32U |
         std::uint64_t{static_cast<std::uint32_t>(at.vertex.y)} << 4U |
         static_cast<std::uint64_t>(at.heading);
}

}  // namespace

std::size_t visit_reachable(const OccupancyGrid& map, const DistanceField& clearance,
                            const PrimitiveSet& primitives, const SweptCells& cells, GridVector start,
                            int heading, std::size_t most, const TakePose& take) {
  const int scale = cells.cells_per_step();
  const std::int32_t columns = map.frame().columns / scale + 1;
  const std::int32_t rows = map.frame().rows / scale + 1;
  const double step_m = primitives.options().resolution_m;
  const geometry::Point origin = map.frame().origin;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  std::unordered_set<std::uint64_t> shown;
  open.push({0, start, heading});
  while (!open.empty() && shown.size() < most) {
    const Open here = open.top();
    open.pop();
    if (!shown.insert(key_of(here)).second) continue;
    const geometry::Pose pose{origin.x_m + step_m * here.vertex.x, origin.y_m + step_m * here.vertex.y,
                              heading_rad(here.heading)};
    if (!take(pose, here.cost_mm)) break;
    const auto first = static_cast<std::size_t>(here.heading) * PrimitiveSet::kPerHeading;
    const auto from = primitives.from(here.heading);
    for (std::size_t k = 0; k < from.size(); ++k) {
      const Open next{here.cost_mm + from[k].cost_mm, here.vertex + from[k].end, from[k].end_heading};
      if (next.vertex.x < 0 || next.vertex.x >= columns || next.vertex.y < 0 || next.vertex.y >= rows)
        continue;
      if (shown.contains(key_of(next)) || !SweptCells::free(map, clearance, cells.of_primitive(first + k),
                                                            {here.vertex.x * scale, here.vertex.y * scale}))
        continue;
      open.push(next);
    }
  }
  return shown.size();
}

}  // namespace stepwright::fleet

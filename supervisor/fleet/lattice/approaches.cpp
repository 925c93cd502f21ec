#include "supervisor/fleet/lattice/approaches.h"

#include <cmath>
#include <vector>

#include "supervisor/fleet/lattice/heading.h"

namespace stepwright::fleet {

namespace {

struct At {
  GridVector vertex;
  int heading = 0;
};

std::uint64_t key_of(const At& at) {
  return std::uint64_t{static_cast<std::uint32_t>(at.vertex.x)} << 32U |
         std::uint64_t{static_cast<std::uint32_t>(at.vertex.y)} << 4U |
         static_cast<std::uint64_t>(at.heading);
}

// The primitives that end with each heading.
std::vector<std::vector<std::size_t>> arrivals_of(const PrimitiveSet& primitives) {
  std::vector<std::vector<std::size_t>> arrivals(kHeadings);
  for (std::size_t k = 0; k < primitives.all().size(); ++k)
    arrivals[static_cast<std::size_t>(primitives.all()[k].end_heading)].push_back(k);
  return arrivals;
}

}  // namespace

std::optional<Approaches> Approaches::find(const OccupancyGrid& map, const DistanceField& clearance,
                                           const PrimitiveSet& primitives, const SweptCells& cells,
                                           GridVector goal, int heading, std::size_t most) {
  const int scale = cells.cells_per_step();
  const std::int32_t columns = map.frame().columns / scale + 1;
  const std::int32_t rows = map.frame().rows / scale + 1;
  const auto arrivals = arrivals_of(primitives);
  Approaches found(map.frame(), primitives.options().resolution_m);
  std::vector<At> open = {{goal, heading}};
  found.poses_.insert(key_of(open.front()));
  while (!open.empty()) {
    const At here = open.back();
    open.pop_back();
    for (const std::size_t k : arrivals[static_cast<std::size_t>(here.heading)]) {
      const At from{here.vertex - primitives.all()[k].end, static_cast<int>(k / PrimitiveSet::kPerHeading)};
      if (from.vertex.x < 0 || from.vertex.x >= columns || from.vertex.y < 0 || from.vertex.y >= rows)
        continue;
      if (found.poses_.contains(key_of(from)) ||
          !SweptCells::free(map, clearance, cells.of_primitive(k),
                            {from.vertex.x * scale, from.vertex.y * scale}))
        continue;
      if (found.poses_.size() >= most) return std::nullopt;
      found.poses_.insert(key_of(from));
      open.push_back(from);
    }
  }
  return found;
}

bool Approaches::hold(const geometry::Pose& from) const {
  const At at{{static_cast<std::int32_t>(std::lround((from.x_m - frame_.origin.x_m) / step_m_)),
               static_cast<std::int32_t>(std::lround((from.y_m - frame_.origin.y_m) / step_m_))},
              nearest_heading(from.heading_rad)};
  return poses_.contains(key_of(at));
}

}  // namespace stepwright::fleet

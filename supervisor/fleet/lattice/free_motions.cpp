#include "supervisor/fleet/lattice/free_motions.h"

#include <algorithm>
#include <atomic>
#include <thread>

namespace stepwright::fleet {

namespace {

// Calls work(row) for each row of vertices, on several threads.
template <typename Work>
void each_row(std::int32_t rows, unsigned threads, Work&& work) {
  std::atomic<std::int32_t> next = 0;
  const auto share = [&] {
    for (std::int32_t row = next++; row < rows; row = next++) work(row);
  };
  std::vector<std::jthread> helpers;
  for (unsigned k = 1; k < threads; ++k) helpers.emplace_back(share);
  share();
}

}  // namespace

// First where the vehicle can stand, which numbers the poses, then where it can drive from there.
FreeMotions::FreeMotions(const OccupancyGrid& map, const DistanceField& clearance,
                         const PrimitiveSet& primitives, const SweptCells& cells, unsigned threads)
    : columns_(map.frame().columns / cells.cells_per_step() + 1),
      rows_(map.frame().rows / cells.cells_per_step() + 1),
      vertices_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  const int scale = cells.cells_per_step();
  const auto vertex = [&](std::int32_t column, std::int32_t row) -> Vertex& {
    return vertices_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                     static_cast<std::size_t>(column)];
  };
  each_row(rows_, threads, [&](std::int32_t row) {
    for (std::int32_t column = 0; column < columns_; ++column) {
      for (int heading = 0; heading < kHeadings; ++heading) {
        if (SweptCells::free(map, clearance, cells.of_heading(heading), {column * scale, row * scale}))
          vertex(column, row).headings |= 1U << heading;
      }
    }
  });
  for (Vertex& at : vertices_) {
    at.first = poses_;
    poses_ += ones(at.headings);
  }
  free_.resize(poses_, 0);
  each_row(rows_, threads, [&](std::int32_t row) {
    for (std::int32_t column = 0; column < columns_; ++column) {
      for (int heading = 0; heading < kHeadings; ++heading) {
        const auto pose = number({column, row}, heading);
        if (!pose) continue;
        const auto first = static_cast<std::size_t>(heading) * PrimitiveSet::kPerHeading;
        for (std::size_t k = 0; k < PrimitiveSet::kPerHeading; ++k) {
          const MotionPrimitive& primitive = primitives.all()[first + k];
          const bool drivable =
              number(GridVector{column, row} + primitive.end, primitive.end_heading).has_value() &&
              SweptCells::free(map, clearance, cells.of_primitive(first + k), {column * scale, row * scale});
          if (drivable) free_[*pose] = static_cast<std::uint16_t>(free_[*pose] | 1U << k);
        }
      }
    }
  });
}

}  // namespace stepwright::fleet

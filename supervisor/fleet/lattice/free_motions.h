#pragma once

// Free motions: the primitives that a vehicle can drive from each pose of the lattice on one floor. It is
// every collision check of the floor, made once, for work that comes to all of it.
//
// A value that does not change; any thread may read. Poses in which the vehicle cannot stand have no number.
//
//   const FreeMotions motions(map, clearance, primitives, cells, 2);
//   // Bit k of what is used stands for the pose's k-th primitive.
//   if (const auto pose = motions.number({40, 12}, 3)) use(motions.from(*pose));

#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/fleet/lattice/swept_cells.h"

namespace stepwright::fleet {

class FreeMotions {
 public:
  // `threads` share the work.
  FreeMotions(const OccupancyGrid& map, const DistanceField& clearance, const PrimitiveSet& primitives,
              const SweptCells& cells, unsigned threads);

  std::int32_t columns() const { return columns_; }  // of vertices
  std::int32_t rows() const { return rows_; }
  // How many poses there are in which the vehicle can stand; they are numbered from 0.
  std::uint32_t poses() const { return poses_; }
  // Nothing for a pose in collision, or off the lattice.
  std::optional<std::uint32_t> number(GridVector vertex, int heading) const {
    if (vertex.x < 0 || vertex.x >= columns_ || vertex.y < 0 || vertex.y >= rows_) return std::nullopt;
    const Vertex& at = vertices_[static_cast<std::size_t>(vertex.y) * static_cast<std::size_t>(columns_) +
                                 static_cast<std::size_t>(vertex.x)];
    if ((at.headings >> heading & 1U) == 0) return std::nullopt;
    return at.first + ones(at.headings & ((1U << heading) - 1U));
  }
  // Bit k: the k-th primitive of its heading meets no obstacle and stays on the map.
  std::uint16_t from(std::uint32_t pose) const { return free_[pose]; }

 private:
  // Of sixteen bits; std::popcount is a call where the processor is not known to count.
  static constexpr std::uint32_t ones(std::uint32_t bits) {
    bits -= bits >> 1 & 0x5555U;
    bits = (bits & 0x3333U) + (bits >> 2 & 0x3333U);
    bits = (bits + (bits >> 4)) & 0x0F0FU;
    return (bits + (bits >> 8)) & 0x1FU;
  }
  struct Vertex {
    std::uint32_t first = 0;     // number of its first pose
    std::uint32_t headings = 0;  // in which the vehicle can stand there
  };

  std::int32_t columns_ = 0;
  std::int32_t rows_ = 0;
  std::uint32_t poses_ = 0;
  std::vector<Vertex> vertices_;
  std::vector<std::uint16_t> free_;  // by pose
};

}  // namespace stepwright::fleet

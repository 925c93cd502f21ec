#pragma once

// Nodes of a search, one for each pose that it has met: tiles of the lattice, taken when the search first
// comes there, so that a short way on a large map stays small. One thread at a time.

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "supervisor/fleet/lattice/heading.h"

namespace stepwright::fleet::internal {

inline constexpr std::uint32_t kUnreached = std::numeric_limits<std::uint32_t>::max();
inline constexpr std::uint8_t kNoPrimitive = 255;

struct SearchNode {
  std::uint32_t cost_mm = kUnreached;      // of the best way from the start
  std::uint32_t estimate_mm = 0;           // of the way to the goal; valid once reached
  std::uint16_t closed_in = 0;             // the round in which it was expanded last
  std::uint8_t arrived_by = kNoPrimitive;  // the k-th primitive of the heading that it came from
  std::uint8_t came_from = 0;              // that heading
  bool inconsistent = false;               // on the list of those to look at in the next round
};

struct LatticePose {
  GridVector vertex;
  int heading = 0;

  friend bool operator==(const LatticePose&, const LatticePose&) = default;
};

class NodeStore {
 public:
  NodeStore(std::int32_t columns, std::int32_t rows)
      : tile_columns_((columns + kSide - 1) / kSide),
        tiles_(static_cast<std::size_t>(tile_columns_) *
               static_cast<std::size_t>((rows + kSide - 1) / kSide)) {}

  // Requires a vertex of the lattice.
  std::uint32_t state_of(const LatticePose& pose) const {
    const auto tile =
        static_cast<std::uint32_t>((pose.vertex.y / kSide) * tile_columns_ + pose.vertex.x / kSide);
    const auto inner = static_cast<std::uint32_t>((pose.vertex.y % kSide) * kSide + pose.vertex.x % kSide);
    return (tile * kSide * kSide + inner) * kHeadings + static_cast<std::uint32_t>(pose.heading);
  }
  LatticePose pose_of(std::uint32_t state) const {
    const auto vertex = static_cast<std::int32_t>(state / kHeadings);
    const std::int32_t tile = vertex / (kSide * kSide);
    const std::int32_t inner = vertex % (kSide * kSide);
    return {{(tile % tile_columns_) * kSide + inner % kSide, (tile / tile_columns_) * kSide + inner / kSide},
            static_cast<int>(state % kHeadings)};
  }
  SearchNode& node(std::uint32_t state) {
    auto& tile = tiles_[state / kTileStates];
    if (!tile) {
      tile = std::make_unique<Tile>();
      ++taken_;
    }
    return tile->nodes[state % kTileStates];
  }
  std::size_t bytes() const { return taken_ * sizeof(Tile) + tiles_.size() * sizeof(tiles_[0]); }

 private:
  static constexpr std::int32_t kSide = 4;
  static constexpr std::uint32_t kTileStates = kSide * kSide * kHeadings;
  struct Tile {
    std::array<SearchNode, kTileStates> nodes;
  };

  std::int32_t tile_columns_;
  std::vector<std::unique_ptr<Tile>> tiles_;
  std::size_t taken_ = 0;
};

}  // namespace stepwright::fleet::internal

#pragma once

// One search from a start to a goal: the rounds of ARA* (Likhachev, Gordon, Thrun 2003). Not for several
// threads.
//
//   LatticeSearch search(floor, start, goal, options);
//   while (search.run_round(weight) == RoundEnd::Solved && weight > 1) ...

#include <chrono>
#include <cstdint>
#include <vector>

#include "supervisor/fleet/lattice/cost_to_go.h"
#include "supervisor/fleet/lattice/heuristic_table.h"
#include "supervisor/fleet/lattice/internal/node_store.h"
#include "supervisor/fleet/lattice/lattice_path.h"
#include "supervisor/fleet/lattice/obstacle_distances.h"
#include "supervisor/fleet/lattice/swept_cells.h"

namespace stepwright::fleet::internal {

// Map, tables and primitives of a search; all outlive it.
struct SearchFloor {
  const OccupancyGrid& map;
  const DistanceField& clearance;
  const PrimitiveSet& primitives;
  const SweptCells& cells;
  const HeuristicTable& table;
  const ObstacleDistances* around = nullptr;  // one of these two, or both
  const CostToGo* to_go = nullptr;
  std::int32_t columns = 0;  // of vertices
  std::int32_t rows = 0;
};

enum class RoundEnd : std::uint8_t { Solved, NoPath, Deadline, Cancelled };

class LatticeSearch {
 public:
  LatticeSearch(const SearchFloor& floor, const LatticePose& start, const LatticePose& goal,
                const PathOptions& options);

  // Improves the path until it costs at most `weight` times the least cost, if the estimate is consistent.
  RoundEnd run_round(double weight);

  bool solved() const { return goal_cost_ != kUnreached; }
  std::uint32_t cost_mm() const { return goal_cost_; }
  // No path costs less: the least of cost and admissible estimate over all that is still open.
  std::uint32_t lower_bound_mm();
  std::uint64_t expanded() const { return expanded_; }
  std::size_t bytes() const { return nodes_.bytes() + open_.capacity() * sizeof(Entry); }
  // The primitives from start to goal, as indices into PrimitiveSet::all. Requires a path.
  std::vector<std::size_t> way();

 private:
  struct Entry {
    std::uint32_t key;
    std::uint32_t cost;
    std::uint32_t state;
  };
  static bool later(const Entry& a, const Entry& b) {
    return a.key != b.key ? a.key > b.key : a.cost < b.cost;
  }

  std::uint32_t estimate(const LatticePose& pose, Heuristic heuristic) const;
  std::uint32_t key_of(const SearchNode& node) const;
  void push(std::uint32_t state, const SearchNode& node);
  void reopen_all();
  void expand(std::uint32_t state);
  void offer(std::size_t index, const LatticePose& to, std::uint32_t cost);

  const SearchFloor& floor_;
  const PathOptions& options_;
  LatticePose goal_;
  NodeStore nodes_;
  std::uint32_t start_state_ = 0;
  std::uint32_t goal_state_ = 0;
  std::uint32_t goal_cost_ = kUnreached;
  double weight_ = 1.0;
  std::uint16_t round_ = 0;
  std::uint64_t expanded_ = 0;
  std::vector<Entry> open_;                  // a heap; entries whose cost is not the node's are out of date
  std::vector<std::uint32_t> inconsistent_;  // made cheaper after they were expanded in this round
};

}  // namespace stepwright::fleet::internal

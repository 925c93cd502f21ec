#include "supervisor/fleet/lattice/internal/lattice_search.h"

#include <algorithm>
#include <cmath>

namespace stepwright::fleet::internal {

namespace {

constexpr std::uint64_t kExpansionsBetweenLooks = 256;  // at the clock and whether it is cancelled

constexpr double kLargestKey = 4e9;

std::uint32_t euclid_mm(GridVector offset, double resolution_m) {
  const double squared = double(offset.x) * offset.x + double(offset.y) * offset.y;
  return static_cast<std::uint32_t>(1000.0 * resolution_m * std::sqrt(squared));
}

}  // namespace

LatticeSearch::LatticeSearch(const SearchFloor& floor, const LatticePose& start, const LatticePose& goal,
                             const PathOptions& options)
    : floor_(floor), options_(options), goal_(goal), nodes_(floor.columns, floor.rows) {
  start_state_ = nodes_.state_of(start);
  goal_state_ = nodes_.state_of(goal);
  SearchNode& node = nodes_.node(start_state_);
  node.cost_mm = 0;
  node.estimate_mm = estimate(start, options.heuristic);
  node.inconsistent = true;
  inconsistent_.push_back(start_state_);
  if (start_state_ == goal_state_) goal_cost_ = 0;
}

std::uint32_t LatticeSearch::estimate(const LatticePose& pose, Heuristic heuristic) const {
  if (floor_.to_go != nullptr && heuristic == Heuristic::Combined) {
    const std::uint32_t known = floor_.to_go->lower_bound_mm(pose.vertex, pose.heading);
    return floor_.around == nullptr ? known : std::max(known, floor_.around->lower_bound_mm(pose.vertex));
  }
  const GridVector offset = pose.vertex - goal_.vertex;
  std::uint32_t bound = euclid_mm(offset, floor_.primitives.options().resolution_m);
  if (heuristic == Heuristic::Euclid) return bound;
  bound = std::max(bound, floor_.table.cost_mm(offset, pose.heading, goal_.heading));
  return heuristic == Heuristic::Table ? bound : std::max(bound, floor_.around->lower_bound_mm(pose.vertex));
}

std::uint32_t LatticeSearch::key_of(const SearchNode& node) const {
  return static_cast<std::uint32_t>(std::min(node.cost_mm + weight_ * node.estimate_mm, kLargestKey));
}

void LatticeSearch::push(std::uint32_t state, const SearchNode& node) {
  open_.push_back({key_of(node), node.cost_mm, state});
  std::ranges::push_heap(open_, later);
}

// The open list of a new round: what is left of the last one and what became cheaper meanwhile, with new
// keys.
void LatticeSearch::reopen_all() {
  std::erase_if(open_, [&](const Entry& entry) {
    const SearchNode& node = nodes_.node(entry.state);
    return node.cost_mm != entry.cost || node.closed_in == round_;
  });
  for (const std::uint32_t state : inconsistent_) {
    SearchNode& node = nodes_.node(state);
    node.inconsistent = false;
    open_.push_back({0, node.cost_mm, state});
  }
  inconsistent_.clear();
  for (Entry& entry : open_) entry.key = key_of(nodes_.node(entry.state));
  std::ranges::make_heap(open_, later);
  ++round_;
}

RoundEnd LatticeSearch::run_round(double weight) {
  weight_ = weight;
  reopen_all();
  while (!open_.empty() && goal_cost_ > open_.front().key) {
    const Entry entry = open_.front();
    std::ranges::pop_heap(open_, later);
    open_.pop_back();
    SearchNode& node = nodes_.node(entry.state);
    if (node.cost_mm != entry.cost || node.closed_in == round_) continue;
    node.closed_in = round_;
    expand(entry.state);
    if (++expanded_ % kExpansionsBetweenLooks != 0) continue;
    if (options_.cancel != nullptr && options_.cancel->load()) return RoundEnd::Cancelled;
    if (options_.most_expanded != 0 && expanded_ >= options_.most_expanded) return RoundEnd::Deadline;
    if (options_.deadline && std::chrono::steady_clock::now() >= *options_.deadline)
      return RoundEnd::Deadline;
  }
  return solved() ? RoundEnd::Solved : RoundEnd::NoPath;
}

void LatticeSearch::expand(std::uint32_t state) {
  const LatticePose from = nodes_.pose_of(state);
  const std::uint32_t cost = nodes_.node(state).cost_mm;
  const auto first = static_cast<std::size_t>(from.heading) * PrimitiveSet::kPerHeading;
  for (std::size_t k = 0; k < PrimitiveSet::kPerHeading; ++k) {
    const MotionPrimitive& primitive = floor_.primitives.all()[first + k];
    const LatticePose to{from.vertex + primitive.end, primitive.end_heading};
    const bool within =
        to.vertex.x >= 0 && to.vertex.x < floor_.columns && to.vertex.y >= 0 && to.vertex.y < floor_.rows;
    if (within) offer(first + k, to, cost + primitive.cost_mm);
  }
}

void LatticeSearch::offer(std::size_t index, const LatticePose& to, std::uint32_t cost) {
  const std::uint32_t state = nodes_.state_of(to);
  SearchNode& node = nodes_.node(state);
  if (cost >= node.cost_mm) return;
  const GridVector start = to.vertex - floor_.primitives.all()[index].end;
  const int scale = floor_.cells.cells_per_step();
  if (!SweptCells::free(floor_.map, floor_.clearance, floor_.cells.of_primitive(index),
                        {start.x * scale, start.y * scale})) {
    return;
  }
  if (node.cost_mm == kUnreached) node.estimate_mm = estimate(to, options_.heuristic);
  if (node.estimate_mm == CostToGo::kNoWay) {
    node.cost_mm = 0;  // nobody offers it again
    return;
  }
  node.cost_mm = cost;
  node.arrived_by = static_cast<std::uint8_t>(index % PrimitiveSet::kPerHeading);
  node.came_from = static_cast<std::uint8_t>(index / PrimitiveSet::kPerHeading);
  if (state == goal_state_) goal_cost_ = cost;
  // The estimate may fall faster than the cost rises at the edge of the table: A* opens such poses again.
  // With a weight they wait for the next round, as in ARA*.
  if (node.closed_in == round_ && weight_ > 1.0) {
    if (!node.inconsistent) inconsistent_.push_back(state);
    node.inconsistent = true;
    return;
  }
  node.closed_in = 0;
  push(state, node);
}

std::uint32_t LatticeSearch::lower_bound_mm() {
  std::uint32_t bound = goal_cost_;
  const auto look_at = [&](std::uint32_t state) {
    const SearchNode& node = nodes_.node(state);
    bound = std::min(bound, node.cost_mm + estimate(nodes_.pose_of(state), Heuristic::Combined));
  };
  for (const Entry& entry : open_) {
    const SearchNode& node = nodes_.node(entry.state);
    if (node.cost_mm == entry.cost && node.closed_in != round_) look_at(entry.state);
  }
  for (const std::uint32_t state : inconsistent_) look_at(state);
  return bound;
}

std::vector<std::size_t> LatticeSearch::way() {
  std::vector<std::size_t> primitives;
  for (std::uint32_t state = goal_state_; state != start_state_;) {
    const SearchNode& node = nodes_.node(state);
    primitives.push_back(std::size_t{node.came_from} * PrimitiveSet::kPerHeading + node.arrived_by);
    const MotionPrimitive& primitive = floor_.primitives.all()[primitives.back()];
    const LatticePose pose = nodes_.pose_of(state);
    state = nodes_.state_of({pose.vertex - primitive.end, primitive.start_heading});
  }
  std::ranges::reverse(primitives);
  return primitives;
}

}  // namespace stepwright::fleet::internal

#include "supervisor/fleet/lattice/heuristic_table.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <thread>

#include "supervisor/fleet/lattice/internal/cost_buckets.h"

namespace stepwright::fleet {

namespace {

constexpr std::uint64_t kStatesBetweenLooks = 4096;  // whether it is cancelled
constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

// Edges of the lattice against their direction: where one comes from to arrive with a heading.
struct Arrival {
  GridVector step;  // from the end of the edge to its start
  int heading = 0;  // at the start
  std::uint32_t cost_mm = 0;
};

std::vector<std::vector<Arrival>> arrivals_by_heading(const PrimitiveSet& primitives) {
  std::vector<std::vector<Arrival>> arrivals(kHeadings);
  for (const MotionPrimitive& p : primitives.all()) {
    arrivals[static_cast<std::size_t>(p.end_heading)].push_back(
        {GridVector{} - p.end, p.start_heading, p.cost_mm});
  }
  return arrivals;
}

// Least costs to (0, 0, goal heading) within a square around it.
class BackwardSearch {
 public:
  BackwardSearch(const std::vector<std::vector<Arrival>>& arrivals, std::int32_t half, std::uint32_t longest)
      : arrivals_(arrivals), half_(half), side_(2 * half + 1), buckets_(longest) {
    costs_.assign(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_) * kHeadings, kNever);
  }

  // Stops where ways that leave the square and come `way_back_mm` back might be cheaper, or than
  // kMostCost_mm. False: it was cancelled, and costs mean nothing.
  bool run(int goal_heading, std::uint64_t way_back_mm, const std::atomic<bool>* cancel) {
    std::uint64_t looked_at = 0;
    offer({}, goal_heading, 0);
    while (const auto next = buckets_.pop()) {
      const auto [cost, state] = *next;
      if (costs_[state] != cost) continue;
      if (cancel != nullptr && ++looked_at % kStatesBetweenLooks == 0 && cancel->load()) return false;
      if (cost > HeuristicTable::kMostCost_mm || cost > cost_of_leaving_ + way_back_mm) break;
      const auto vertex = static_cast<std::int32_t>(state / kHeadings);
      const GridVector at{vertex % side_ - half_, vertex / side_ - half_};
      for (const Arrival& arrival : arrivals_[state % kHeadings]) {
        offer(at + arrival.step, arrival.heading, cost + arrival.cost_mm);
      }
    }
    return true;
  }

  std::uint32_t cost(GridVector at, int heading) const { return costs_[index(at, heading)]; }
  // No way that leaves the square is cheaper before it comes back.
  std::uint32_t cost_of_leaving() const { return cost_of_leaving_; }

 private:
  std::size_t index(GridVector at, int heading) const {
    return (static_cast<std::size_t>(at.y + half_) * static_cast<std::size_t>(side_) +
            static_cast<std::size_t>(at.x + half_)) *
               kHeadings +
           static_cast<std::size_t>(heading);
  }

  void offer(GridVector at, int heading, std::uint32_t cost) {
    if (std::abs(at.x) > half_ || std::abs(at.y) > half_) {
      cost_of_leaving_ = std::min(cost_of_leaving_, cost);
      return;
    }
    const std::size_t state = index(at, heading);
    if (cost >= costs_[state]) return;
    costs_[state] = cost;
    buckets_.push(cost, static_cast<std::uint32_t>(state));
  }

  const std::vector<std::vector<Arrival>>& arrivals_;
  std::int32_t half_;
  std::int32_t side_;
  std::vector<std::uint32_t> costs_;
  internal::CostBuckets buckets_;
  std::uint32_t cost_of_leaving_ = kNever;
};

std::int32_t in_vertices(double length_m, const PrimitiveSet& primitives) {
  return static_cast<std::int32_t>(std::floor(length_m / primitives.options().resolution_m + 1e-6));
}

}  // namespace

HeuristicTable::HeuristicTable(std::int32_t range)
    : range_(range),
      costs_(static_cast<std::size_t>(kQuarter) * static_cast<std::size_t>(2 * range + 1) *
             static_cast<std::size_t>(2 * range + 1) * kHeadings) {}

std::int32_t HeuristicTable::range_in_vertices(const PrimitiveSet& primitives, const TableOptions& options) {
  return in_vertices(options.range_m, primitives);
}

// A way that leaves the square comes back to the range over the margin at least, at a cost of no less than a
// metre for a metre.
HeuristicTable HeuristicTable::build(const PrimitiveSet& primitives, const TableOptions& options) {
  HeuristicTable table(range_in_vertices(primitives, options));
  const std::int32_t margin = std::max(in_vertices(options.margin_m, primitives), 1);
  const auto arrivals = arrivals_by_heading(primitives);
  std::uint32_t longest = 0;
  for (const MotionPrimitive& p : primitives.all()) longest = std::max(longest, p.cost_mm);
  const auto way_back_mm =
      static_cast<std::uint64_t>(std::floor(1000.0 * margin * primitives.options().resolution_m - 1e-6));
  std::atomic<int> next = 0;
  std::atomic<bool> cancelled = false;
  const auto work = [&] {
    for (int goal = next++; goal < kQuarter; goal = next++) {
      BackwardSearch search(arrivals, table.range_ + margin, longest);
      if (!search.run(goal, way_back_mm, options.cancel)) {
        cancelled = true;
        return;
      }
      const std::uint64_t surely =
          std::min<std::uint64_t>(search.cost_of_leaving() + way_back_mm, kMostCost_mm);
      for (std::int32_t y = -table.range_; y <= table.range_; ++y) {
        for (std::int32_t x = -table.range_; x <= table.range_; ++x) {
          for (int heading = 0; heading < kHeadings; ++heading) {
            table.costs_[table.index(goal, {x, y}, heading)] =
                static_cast<std::uint16_t>(std::min<std::uint64_t>(search.cost({x, y}, heading), surely));
          }
        }
      }
    }
  };
  std::vector<std::jthread> helpers;
  for (unsigned k = 1; k < options.threads; ++k) helpers.emplace_back(work);
  work();
  helpers.clear();
  if (cancelled) std::ranges::fill(table.costs_, std::uint16_t{0});
  return table;
}

}  // namespace stepwright::fleet

#pragma once

// Branch and bound over routes, stop by stop and vehicle by vehicle: complete for one division of the loads.
//
// Nodes are pruned by: a bound (RouteTables, for what is left of this route and the vehicles to come) that is
// no better than the best value, or later than every window; times outside of windows or, where trips are
// coupled, a network that is inconsistent; partial allocations that another one dominates (no coupled trips
// only); all but one of what differs by exchanging trips or vehicles that are alike.
//
//   TripSearch search(model, objective, limits);
//   search.run(best_value);
//   if (search.found()) ...

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "supervisor/fleet/allocation/internal/dominance.h"
#include "supervisor/fleet/allocation/internal/evaluation.h"
#include "supervisor/fleet/allocation/internal/limits.h"
#include "supervisor/fleet/allocation/internal/route_tables.h"

namespace stepwright::fleet::internal {

inline constexpr std::int64_t kNoValue = std::numeric_limits<std::int64_t>::max();

class TripSearch {
 public:
  struct Found {
    Routes routes;
    Evaluation evaluation;
    std::int64_t value = kNoValue;
  };

  // All weights 0: any allocation will do. Requires tables_fit and no contradiction. `nodes`: zero
  // is no limit. The model outlives the search.
  TripSearch(const TripModel& model, const AllocationObjective& objective, const Limits& limits,
             std::uint64_t nodes);

  // Looks for the best allocation below `value`. False if a limit ended that.
  bool run(std::int64_t value);
  const std::optional<Found>& found() const { return found_; }
  std::uint64_t nodes() const { return nodes_; }
  // No allocation is better, kNoValue: there is none.
  std::int64_t root_bound() const;

 private:
  struct Node {
    std::uint32_t vehicle = 0;
    std::uint32_t last = kNone;  // stop; kNone: at the start
    std::int64_t ready_ms = 0;   // the service at the last stop has ended
    TripMask aboard = 0;
    TripMask to_do = 0;  // of all vehicles
    std::uint32_t load = 0;
    std::int64_t makespan_ms = 0;  // of the vehicles before
    std::int64_t travel_ms = 0;
    std::int64_t tardiness_ms = 0;
    std::uint32_t first = kNone;         // trip that this vehicle picked up first
    std::uint32_t first_before = kNone;  // and the vehicle before
  };

  void visit(const Node& node);
  void branch(const Node& node);
  void close(const Node& node);
  void append(const Node& node, StopIndex stop);
  bool may_pick_up(const Node& node, std::uint32_t trip) const;
  void record();

  // No completion has a smaller value.
  std::int64_t bound(const Node& node) const;
  std::int64_t least_tardiness(const Node& node) const;
  // Whether all trips to do can still begin in time.
  bool in_time(const Node& node) const;
  bool dominated(const Node& node);
  std::uint32_t place_of(const Node& node) const;
  std::int32_t least_ride_ms(std::uint32_t trip) const;  // with the service at its beginning
  // In the network: of the first `vehicles` routes, and of what is set down, with `late_ms_`.
  std::int64_t made_makespan(std::uint32_t vehicles) const;
  std::int64_t made_tardiness();
  bool stop();

  const TripModel& model_;
  AllocationObjective objective_;
  const Limits& limits_;
  std::uint64_t most_nodes_;
  RouteTables tables_;
  Network network_;  // used where trips are coupled
  bool any_ = false;
  bool dominance_ = false;
  bool stopped_ = false;
  bool out_ = false;
  std::uint64_t nodes_ = 0;
  std::int64_t best_ = kNoValue;
  Routes routes_;
  std::vector<std::int64_t> late_ms_;  // by transport, of the trips made
  std::int64_t last_end_ms_ = 0;       // no vehicle may be ready later
  // By vehicle and trip: when that vehicle or a later one can begin to pick up, at the earliest.
  std::vector<std::vector<std::int64_t>> pick_up_from_;
  DominanceStore store_;
  std::optional<Found> found_;
};

}  // namespace stepwright::fleet::internal

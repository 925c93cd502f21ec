#pragma once

// Routes that change: trips go in and come out, and what that costs. Where trips are coupled, times are those
// of the windows that the caller sets; the network has the last word.
//
// Every trip that is in is in the route of a vehicle that may take it, within capacity, windows, orders and
// behind what is fixed. Copies are independent; one thread at a time.
//
//   RoutePlan plan(model);                    // what is fixed is in
//   if (const auto at = plan.best_insertion(trip, vehicle, never)) plan.insert(trip, *at);

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "supervisor/fleet/allocation/internal/evaluation.h"

namespace stepwright::fleet::internal {

// Before which stops of the route as it is the pick-up and the set-down go.
struct Insertion {
  double cost = std::numeric_limits<double>::infinity();
  std::uint32_t vehicle = kNone;
  std::uint32_t pick_up = kNone;  // kNone: it is there already, fixed
  std::uint32_t set_down = 0;
};

class RoutePlan {
 public:
  explicit RoutePlan(const TripModel& model);

  const Routes& routes() const { return routes_; }
  // Trips that are not in, or of which the set-down is not.
  const std::vector<std::uint32_t>& missing() const { return missing_; }
  std::uint32_t vehicle_of(std::uint32_t trip) const { return vehicle_of_[trip]; }
  std::int32_t begin_ms(StopIndex stop) const { return begin_ms_[stop]; }
  std::int64_t finish_ms(std::uint32_t vehicle) const { return profiles_[vehicle].finish_ms; }
  // Trips that `remove` may take out.
  bool removable(std::uint32_t trip) const;

  Score score() const;

  // The cheapest way to put the trip into the route. `skip()` is asked for each that would be the cheapest so
  // far: true leaves it out.
  template <typename Skip>
  std::optional<Insertion> best_insertion(std::uint32_t trip, std::uint32_t vehicle, Skip&& skip) {
    candidates_.clear();
    candidate_insertions(trip, vehicle);
    std::optional<Insertion> best;
    for (const Insertion& candidate : candidates_) {
      if (best && candidate.cost >= best->cost) continue;
      if (!skip()) best = candidate;
    }
    return best;
  }
  // All into any route, in no order; until the plan changes.
  std::span<const Insertion> insertions(std::uint32_t trip);

  void insert(std::uint32_t trip, const Insertion& at);
  void remove(std::uint32_t trip);

  // How much of the makespan's weight a millisecond counts of a vehicle that is not the last one to be ready:
  // loads are spread before the makespan shows it.
  void set_spread(double share) { spread_ = share; }

  // Between which times services may begin: from the network, in place of the model's windows.
  void set_windows(const Network& network);

 private:
  struct Profile {
    std::vector<std::int64_t> ready_ms;   // before each stop, and at the end: the service before has ended
    std::vector<std::int64_t> latest_ms;  // of each stop, so that all after it are in time
    std::vector<std::uint32_t> load;      // before each stop, and at the end
    // The vehicle is ready at the end max(begin + after_ms, floor_ms), if stop k begins at `begin`.
    std::vector<std::int64_t> after_ms;
    std::vector<std::int64_t> floor_ms;
    std::int64_t travel_ms = 0;
    std::int64_t finish_ms = 0;
  };
  struct Tail {
    std::int64_t finish_ms = 0;
    std::int64_t later_ms = 0;  // weighted tardiness that is added
  };

  void candidate_insertions(std::uint32_t trip, std::uint32_t vehicle);
  void place_set_down(std::uint32_t trip, std::uint32_t vehicle, std::uint32_t pick_up, std::uint32_t first,
                      std::uint32_t end, std::int64_t ready_ms, std::uint32_t place, std::int64_t added_ms);
  // From before which stop to before which one a trip may be in the route; false: nowhere.
  bool range(std::uint32_t trip, std::uint32_t vehicle, std::uint32_t& first, std::uint32_t& end) const;
  // The vehicle is ready at `place` and makes the stops from `at` on.
  std::optional<Tail> tail(std::uint32_t vehicle, std::uint32_t at, std::int64_t ready_ms,
                           std::uint32_t place) const;
  // The tardiness that is added if the stops from `at` on begin later.
  std::int64_t later_ms(std::uint32_t vehicle, std::uint32_t at, std::int64_t begin_ms) const;
  std::int64_t late_ms(StopIndex stop, std::int64_t begin_ms) const;
  std::int64_t gap_ms(std::uint32_t vehicle, std::uint32_t at, std::uint32_t place) const;
  std::uint32_t place_before(std::uint32_t vehicle, std::uint32_t at) const;
  void refresh(std::uint32_t vehicle);

  const TripModel* model_;
  Routes routes_;
  std::vector<Profile> profiles_;  // by vehicle
  std::vector<std::uint32_t> vehicle_of_;
  std::vector<std::uint32_t> missing_;
  std::vector<char> pick_up_fixed_;
  std::vector<char> set_down_fixed_;
  std::vector<std::int32_t> begin_ms_;  // by stop
  std::vector<std::int32_t> earliest_ms_;
  std::vector<std::int32_t> latest_ms_;
  std::vector<std::int32_t> starts_ms_;
  std::int64_t other_finish_ms_ = 0;
  double spread_ = 0.1;
  std::vector<Insertion> candidates_;
};

}  // namespace stepwright::fleet::internal

#pragma once

// Large neighbourhood search (Shaw 1998; Ropke and Pisinger 2006): a few trips that have to do with each
// other are taken out of the routes and put back one by one where they cost least, or where waiting costs
// most (regret); now and then the best place is passed over (Christiaens and Vanden Berghe 2020). What is
// worse is kept now and then, ever more rarely (simulated annealing).
//
// Where trips are coupled each insertion is posted to the network, and one that contradicts it is not made.
// Every allocation that is found has been evaluated by the network as a whole.
//
//   NeighbourhoodSearch search(model, seed);
//   search.run(1000, limits);
//   if (search.found()) ...

#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "supervisor/fleet/allocation/internal/limits.h"
#include "supervisor/fleet/allocation/internal/route_plan.h"

namespace stepwright::fleet::internal {

class NeighbourhoodSearch {
 public:
  struct Found {
    Routes routes;
    Evaluation evaluation;
    std::int64_t value = 0;
  };

  // The model, without a contradiction, outlives the search.
  NeighbourhoodSearch(const TripModel& model, std::uint64_t seed);

  // Zero iterations: until the limit. Goes on from where the last run ended.
  void run(std::uint64_t iterations, const Limits& limits);
  const std::optional<Found>& found() const { return found_; }
  std::uint64_t iterations() const { return iterations_; }
  // Trips that the best plan so far has no place for.
  const std::vector<std::uint32_t>& missing() const { return best_.missing(); }

 private:
  // Fewer missing trips first, then the value.
  struct Standing {
    std::size_t missing = 0;
    std::int64_t value = 0;
    std::int64_t smooth =
        0;  // what is compared with the plan before: when all vehicles are ready counts, too
    friend auto operator<=>(const Standing&, const Standing&) = default;
  };
  using Trips = std::vector<std::uint32_t>;

  Standing standing(const RoutePlan& plan) const;
  void keep_if_better(const RoutePlan& plan, const Standing& now);
  bool accept(const Standing& now, double temperature);

  Trips ruined(const RoutePlan& plan);
  Trips related_to(std::uint32_t trip, const Trips& among, const RoutePlan& plan);
  Trips of_last_vehicle(const RoutePlan& plan);
  double distance(std::uint32_t a, std::uint32_t b, const RoutePlan& plan) const;

  void recreate(RoutePlan& plan, bool greedy);
  void in_order(RoutePlan& plan, Trips order);
  void by_regret(RoutePlan& plan, const Trips& trips);
  void shuffle(Trips& trips);
  void put_back(RoutePlan& plan, std::uint32_t trip, const std::optional<Insertion>& best);
  // The cheapest insertion into each route, then other cheap ones, then some from all over: cheap places may
  // all be wrong for the same reason.
  std::vector<Insertion> diverse(std::span<const Insertion> all) const;
  void start_network(const RoutePlan& plan);
  bool post(const RoutePlan& plan, std::uint32_t trip, const Insertion& at);

  std::uint64_t below(std::uint64_t bound) { return random_() % bound; }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  const TripModel& model_;
  std::mt19937_64 random_;
  RoutePlan current_;
  RoutePlan best_;
  Standing current_standing_;
  Standing best_standing_;
  bool begun_ = false;
  std::uint64_t iterations_ = 0;
  std::vector<std::vector<std::uint32_t>> coupled_with_;  // by transport
  std::optional<Network> network_;
  std::optional<Found> found_;
};

}  // namespace stepwright::fleet::internal

#pragma once

// Shorter plans for a train: other routes, from the start or from anywhere on the plan so far, pulled tight
// and driven in other styles; and that plan with a point of its route moved, added or left out. What
// counts is the way that is driven, not that of the route; a drive is done anew from shortly before the point
// that moved, and given up where it turns out to be no shorter.
//
// Work is cut into rounds, each of which depends on its seed and on the plan that it begins with only: who
// runs several Shorteners of one ground, each in its own thread, has the same plans as with one of them.
//
// Thread rule: one thread at a time. The ground must outlive it. Example:
//   Shortener shortener(ground, states);
//   auto best = shortener.round({.start = state, .seed = 7});
//   if (auto shorter = shortener.round({.start = state, .seed = 8, .best = &*best})) best = *shorter;

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>

#include "supervisor/ltl/search/driven_route.h"
#include "supervisor/ltl/search/search_ground.h"

namespace stepwright::ltl {

struct ShortenRound {
  TrainState start{};
  std::uint64_t seed = 1;
  const DrivenRoute* best = nullptr;        // begins at `start`; null: other routes are looked for
  bool other_routes = false;                // from somewhere on the best one, too
  Clearance clearance = Clearance::Wanted;  // of other routes
  bool plain = false;                       // the cheapest route of all from the start
  Stop stop{};
};

class Shortener {
 public:
  Shortener(const SearchGround& ground, TaskStates states);

  // The shortest one of a round, if it is shorter than `best`. Requires a start where a train can stand.
  // was_cut(): `stop` has ended it before it was whole.
  std::optional<DrivenRoute> round(const ShortenRound& asked);
  bool was_cut() const { return was_cut_; }
  std::uint64_t drives() const { return drives_; }

 private:
  // A route that is another one around one of its points, and where a drive along it begins.
  struct Change {
    Route route;
    std::size_t mark = 0;    // of the drive so far
    std::size_t shared = 0;  // points at the end that are the same as before
    double longer_m = 0.0;   // the route itself
  };

  RouteSearch* routes(Clearance clearance);
  void look_for_others(const ShortenRound& asked, std::optional<DrivenRoute>& best);
  std::optional<Drive> best_along(const Route& route, const DriveMark& from, double most_m,
                                  DriveStyle& style);
  void vary(DrivenRoute& best);
  std::optional<Change> changed(const DrivenRoute& from);
  bool move(Change& change, const RoutePoint& before, std::size_t k);
  bool leave_out(Change& change, const RoutePoint& before, std::size_t k);
  bool put_in(Change& change, const RoutePoint& before, std::size_t k);
  std::size_t mark_before(const DrivenRoute& from, std::size_t point);
  std::optional<DrivenRoute> driven(const DrivenRoute& from, const Change& change, const DriveStyle& style);
  DriveStyle varied(DriveStyle style);
  std::uint64_t work() const { return driver_.steps() * ground_.model().links(); }
  double chance() { return std::uniform_real_distribution<double>(0.0, 1.0)(dice_); }
  double bell() { return std::normal_distribution<double>(0.0, 1.0)(dice_); }

  const SearchGround& ground_;
  TaskStates states_;
  Driver driver_;
  std::array<std::unique_ptr<RouteSearch>, kClearances> routes_;
  Stop stop_;
  std::mt19937_64 dice_;
  std::uint64_t drives_ = 0;
  bool was_cut_ = false;
};

}  // namespace stepwright::ltl

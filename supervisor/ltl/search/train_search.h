#pragma once

// Plans for a train that do a task: a tree of states that are driven to in closed loop along routes of a
// point. Most often the first route is the plan; where a train fails to follow one, the tree grows from the
// states before that, by other routes, other styles of driving and, now and then, by any control, so that no
// state that can be reached is left out for ever. Forwards first; in reverse by controls of chance only,
// often straight back from where a train stands.
//
// Source of the tree: E. Plaku 2012, Algorithm 1; what is ours is the guide and the driver.
// Thread rule: one thread at a time; several searches with different seeds may share a ground. The same
// question has the same answer whatever was asked before, unless its time is over; asked for in parts of so
// many rounds it is the same as in one. Example:
//   const SearchGround ground(floor, map, places, model, task.automaton());
//   TrainSearch search(ground, states);
//   const SearchAnswer answer = search.first({.start = state, .seed = 1, .most_s = 10.0});
//   if (answer.plan) ...

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "supervisor/ltl/search/driven_route.h"
#include "supervisor/ltl/search/search_ground.h"

namespace stepwright::ltl {

struct SearchQuery {
  TrainState start{};
  std::uint64_t seed = 1;
  double most_s = 10.0;  // looked at during drives and while routes are looked for
  std::size_t most_rounds = std::numeric_limits<std::size_t>::max();  // drives and tries of any control
  bool by_chance = false;  // the first drive, too: for another plan after one that was of no use
  const std::atomic<bool>* cancel = nullptr;  // not owned; may be null
  const std::atomic<bool>* enough = nullptr;  // likewise: another search has found what was looked for
};

enum class SearchEnd : std::uint8_t {
  Found,
  BadStart,  // in a wall or too near to one, in itself, or the task has failed there
  NoWay,     // a point cannot do the task: why_impossible() says why
  Bound,     // time or rounds are over, or there was enough
  Cancelled,
};

struct SearchAnswer {
  SearchEnd end = SearchEnd::Bound;
  std::optional<TrainPlan> plan;
  std::optional<DrivenRoute> driven;  // the plan with the routes that it follows to its end
  std::size_t drives = 0;             // along routes
  std::size_t nodes = 0;              // of the tree
  std::uint64_t steps = 0;            // of the integration
  double prepared_s = 0.0;            // until the first route was asked for
  double spent_s = 0.0;               // in this search's own parts
};

class TrainSearch {
 public:
  // The ground must outlive it. States of an automaton are the ground's.
  TrainSearch(const SearchGround& ground, TaskStates states);
  ~TrainSearch();

  // The first plan that is found.
  SearchAnswer first(const SearchQuery& query);

  // The same in parts: what is asked, then some rounds at a time until it has an end.
  void ask(const SearchQuery& query);
  bool go_on(std::size_t rounds);
  // Requires an end.
  const SearchAnswer& answer() const { return answer_; }

 private:
  struct Node {
    DriveMark at;  // state, task and label
    std::uint32_t parent = 0;
    std::vector<TrainPiece> pieces;
    std::shared_ptr<const Route> route;  // that leads there; null: a control by chance, or the root
    double length_m = 0.0;               // from the root
    double left_m = 0.0;
    double fails = 0.0;
  };
  using Clock = std::chrono::steady_clock;

  RouteSearch* routes(Clearance clearance);
  DriveStyle style(bool by_chance);
  std::size_t choose();
  std::size_t add(std::size_t parent, const Drive& drive, std::shared_ptr<const Route> route);
  void blame(std::size_t parent, std::size_t first_new, const Drive& drive);
  bool explore(std::size_t from);
  bool drive_from(std::size_t from, bool by_chance);
  bool one_round();
  std::vector<std::size_t> way_to(std::size_t node) const;
  TrainPlan plan_to(std::size_t node) const;
  DrivenRoute driven_to(std::size_t node) const;
  std::optional<SearchEnd> begin();
  std::optional<SearchEnd> over() const;
  void end_with(SearchEnd end);
  Route route_from(const Node& node, RouteSearch& ways, double noise);
  double chance() { return std::uniform_real_distribution<double>(0.0, 1.0)(dice_); }

  const SearchGround& ground_;
  TaskStates states_;
  Driver driver_;
  std::array<std::unique_ptr<RouteSearch>, kClearances> routes_;
  SearchQuery query_;
  SearchAnswer answer_;
  bool has_end_ = true;
  std::size_t round_ = 0;
  std::uint64_t steps_before_ = 0;
  std::size_t most_nodes_ = 0;
  DriveStyle style_of_last_;  // drive along a route
  Stop stop_;
  std::mt19937_64 dice_;
  std::deque<Node> nodes_;
};

// Whether a train can stand there: within the floor as a whole, clear of walls and of itself, within limits.
bool can_stand(const SearchGround& ground, const Driver& driver, const TrainState& state);

}  // namespace stepwright::ltl

#pragma once

// Plans for a train that do a task: a tree of states that are driven to in closed loop along routes of a
// point. Most often the first route is the plan; where a train fails to follow one, the tree grows from the
// states before that, by other routes, other styles of driving and, now and then, by any control, so that no
// state that can be reached is left out for ever. Forwards first; in reverse by controls of chance only,
// often straight back from where a train stands.
//
// Source of the tree: E. Plaku 2012, Algorithm 1; what is ours is the guide and the driver.
// Thread rule: one thread at a time; several searches with different seeds may share floor, map and places.
// The same question to a new search has the same answer, unless its time is over. Example:
//   TrainSearch search(floor, map, places, model, states);
//   const SearchAnswer answer = search.first({.start = state, .seed = 1, .most_s = 10.0});
//   if (answer.plan) ...

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "supervisor/ltl/search/driver.h"

namespace stepwright::ltl {

struct SearchQuery {
  TrainState start{};
  std::uint64_t seed = 1;
  double most_s = 10.0;  // looked at between two drives and while routes are looked for
  std::size_t most_rounds = std::numeric_limits<std::size_t>::max();  // drives and tries of any control
  bool by_chance = false;  // the first drive, too: for another plan after one that was of no use
  const std::atomic<bool>* cancel = nullptr;  // not owned; may be null
};

enum class SearchEnd : std::uint8_t {
  Found,
  BadStart,  // in a wall or too near to one, in itself, or the task has failed there
  NoWay,     // a point cannot do the task: why_impossible() says why
  Bound,     // time or rounds are over
  Cancelled,
};

struct SearchAnswer {
  SearchEnd end = SearchEnd::Bound;
  std::optional<TrainPlan> plan;
  std::size_t drives = 0;   // along routes
  std::size_t nodes = 0;    // of the tree
  std::uint64_t steps = 0;  // of the integration
  double prepared_s = 0.0;  // until the first route was asked for
  double spent_s = 0.0;
};

enum class SearchGuide : std::uint8_t { OnTheRegions, None };

class TrainSearch {
 public:
  // What is borrowed must outlive it. Without a guide routes are searched for on all sides alike.
  TrainSearch(const Floor& floor, const RegionMap& map, const Places& places, const TrainModel& model,
              TaskStates states, SearchGuide use = SearchGuide::OnTheRegions);
  ~TrainSearch();

  // The first plan that is found.
  SearchAnswer first(const SearchQuery& query);
  // A shorter one than that, by other routes and styles, until time or rounds are over.
  SearchAnswer shorter(const SearchQuery& query, double than_m);

 private:
  struct Node {
    DriveMark at;  // state, task and label
    std::uint32_t parent = 0;
    std::vector<TrainPiece> pieces;
    double length_m = 0.0;  // from the root
    double left_m = 0.0;
    double fails = 0.0;
  };
  struct Routes;
  using Clock = std::chrono::steady_clock;

  Routes& routes(std::size_t level);
  DriveStyle style(bool by_chance);
  std::size_t choose();
  std::size_t add(std::size_t parent, const Drive& drive);
  void blame(std::size_t parent, std::size_t first_new, const Drive& drive);
  bool explore(std::size_t from);
  bool drive_from(std::size_t from, bool by_chance, SearchAnswer& answer);
  TrainPlan plan_to(std::size_t node) const;
  std::optional<SearchEnd> begin(const SearchQuery& query);
  bool stands(const TrainState& state) const;
  std::optional<SearchEnd> over(const SearchQuery& query, std::size_t rounds) const;
  Route route_from(const Node& node, Routes& ways, double turn_m, double noise);
  double chance() { return std::uniform_real_distribution<double>(0.0, 1.0)(dice_); }

  const Floor& floor_;
  const RegionMap& map_;
  const Places& places_;
  TrainModel model_;
  TaskStates states_;
  SearchGuide use_;
  TrainModel wide_;  // a little larger, for what happens between two steps
  Walls walls_;
  Driver driver_;
  std::optional<Guide> guide_;  // of automata
  std::vector<std::unique_ptr<Routes>> routes_;
  Clock::time_point until_ = Clock::time_point::max();  // of the question that is answered
  std::mt19937_64 dice_;
  std::deque<Node> nodes_;
};

}  // namespace stepwright::ltl

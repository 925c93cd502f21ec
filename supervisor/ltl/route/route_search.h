#pragma once

// The cheapest way of a point that does a task, in the product of a route graph and the task's states
// (forwards; only states that are met exist, so that a task may be a progression). Turns cost what a train
// needs for them; as what a turn costs depends on the way to it, the result is near to the cheapest. The
// guide, where there is one, tells which way is worth trying first (A*).
//
// Thread rule: one thread at a time; several may share graph and guide, which must outlive them. A question
// has the same answer whatever was asked before. Example:
//   RouteSearch search(graph, states, {&map, &guide});
//   auto route = search.route({.at = {0, 0}, .heading_rad = 0.0, .state = states.start()});

#include <limits>
#include <optional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include "supervisor/ltl/guide/guide.h"
#include "supervisor/ltl/guide/task_states.h"
#include "supervisor/ltl/route/route_graph.h"

namespace stepwright::ltl {

struct RoutePoint {
  geometry::Point at;
  std::uint32_t state = 0;             // of the task, once the point is reached
  std::vector<std::uint32_t> through;  // states on the way to it that differ from the one before; the last
                                       // is `state` unless nothing changed
};
using Route = std::vector<RoutePoint>;  // begins where the train is

struct RouteQuery {
  geometry::Point at;
  double heading_rad = 0.0;
  std::uint32_t state = 0;  // has read the label at that point
  double turn_m = 1.0;      // cost of a turn of one radian
  double close_m = 6.0;     // cost of passing a place closely that must not be entered
  // What is pulled cuts a turn by so many metres times the sine of half of its angle; where it comes nearer
  // to a wall than `half_m`, the turn costs up to cut_m more.
  double trail_m = 0.0;
  double half_m = 0.0;
  double cut_m = 40.0;
  double noise = 0.0;  // ways cost up to so much more or less, as a share, by chance
  std::uint64_t seed = 0;
  std::size_t most_nodes = 4'000'000;  // of the product
  Stop stop{};
};

// Costs to go on the floor's regions, of automata; without them, states that need fewer places come first, by
// so many metres a place. Such a route is no cheapest one, and found where there are more states than can be
// looked at.
struct RouteGuide {
  const RegionMap* map = nullptr;
  const Guide* guide = nullptr;
  double place_m = 0.0;
};

class RouteSearch {
 public:
  RouteSearch(const RouteGraph& graph, TaskStates states, const RouteGuide& guide = {});

  // From there to acceptance; empty if there is no way, or a bound was met (most_nodes, stop, that of a
  // progression).
  Route route(const RouteQuery& query);
  // The same places in the same order on a shorter way, whose bends keep `margin_m` from walls: points move
  // and vanish while that makes it shorter. Requires a route of this search.
  Route tightened(Route route, double margin_m, const Stop& stop);
  // The next point of a route, with what is read on the way to it; nothing where no way leads there.
  std::optional<RoutePoint> reached(const RoutePoint& from, geometry::Point to);
  const RouteGraph& graph() const { return graph_; }
  std::size_t expanded() const { return expanded_; }

 private:
  static constexpr std::uint32_t kBroken = 0xFFFF'FFFF;  // after a word that breaks the task
  static constexpr std::uint32_t kUnknown = 0xFFFF'FFFE;
  static constexpr std::uint32_t kStart = 0xFFFF'FFFF;  // before the first node

  struct Node {
    double cost_m = std::numeric_limits<double>::infinity();
    std::uint32_t before = kStart;
    const RouteGraph::Way* way = nullptr;
    bool done = false;
  };
  // From a node, or from where the query begins, along a way.
  struct Step {
    std::uint32_t before = 0;  // the node
    std::uint32_t row = 0;     // of its state
    geometry::Point at;
    geometry::Point came;  // from where, as a vector
    double cost_m = 0.0;
    const RouteGraph::Way* way = nullptr;
  };
  using Open = std::pair<double, std::uint32_t>;
  // Of a state, from question to question.
  struct Known {
    double left_m = 0.0;                        // to go, by the places that it needs
    std::vector<std::uint32_t> after;           // by word; not of progressions
    std::unordered_map<Label, bool> broken_by;  // places close by
  };
  struct Row {
    std::uint32_t state = 0;
    Known* known = nullptr;
  };

  std::uint32_t after(std::uint32_t row, const RouteGraph::Way& way, const RouteGraph::Words& words);
  bool close(std::uint32_t row, Label near);
  std::uint32_t row(std::uint32_t state);
  double cut_m(const Step& step, geometry::Point out, const RouteQuery& query) const;
  void relax(const Step& step, const RouteQuery& query, const RouteGraph::Words& words);
  double to_go_m(std::uint32_t point, std::uint32_t row) const;
  Node& node(std::uint32_t index) { return is_sparse_ ? sparse_[index] : dense_[index]; }
  std::size_t size() const { return is_sparse_ ? sparse_.size() : dense_.size(); }
  std::optional<double> moved(Route& route, std::size_t k, geometry::Point to, double margin_m);
  bool dropped(Route& route, std::size_t k);
  Route path(std::uint32_t last, const RouteQuery& query, const RouteGraph::Words& own);

  const RouteGraph& graph_;
  TaskStates states_;
  RouteGuide guide_;
  std::vector<std::uint32_t> regions_;                     // of each point
  std::unordered_map<std::uint32_t, std::uint32_t> rows_;  // of each state that this question has met
  std::vector<Row> row_;
  std::unordered_map<std::uint32_t, Known> known_;
  bool is_sparse_ = false;  // of progressions: few of their states' points are met
  std::vector<Node> dense_;
  std::unordered_map<std::uint32_t, Node> sparse_;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
  std::size_t expanded_ = 0;
};

}  // namespace stepwright::ltl

#pragma once

// A* in the lexicographic order (cost, number of steps): the proof. Optionally weighted and guided by the
// relaxed plan, for improvement before the proof.
//
// Costs may depend on the state: they are differences of the metric between two states. What the metric
// accumulates never falls as long as no operator's accumulated cost can be negative (an interval over all
// reachable states says so); then accumulated + bound + least potential bounds every plan through a state
// from below. If some can be negative there is no such bound: the search then visits every reachable state,
// reopening those that a cheaper way reaches, and only its end is a proof. A cycle of falling cost would make
// that endless; it is recognized when a state is reached again from itself at less cost.
//
// Thread rule: one call, one object. `run` can be resumed after it returned Running.

#include "supervisor/pddl/search/greedy_search.h"
#include "supervisor/pddl/search/lower_bounds.h"

namespace stepwright::pddl {

class AStarSearch {
 public:
  // weight 0: plain A* with admissible bounds, whose end is a proof. Otherwise: weighted A* on the relaxed
  // plan; its end (Exhausted) is a proof too, as only what cannot beat the incumbent is left out.
  AStarSearch(const StateSpace& space, SearchControl& control, const LowerBounds& bounds, double weight);

  // Expands at most `expansions` states. Found: a better plan was offered to the control (weighted search
  // only). Exhausted: no better plan than the control's best exists. Stopped: see `reason`.
  SearchStatus run(std::uint64_t expansions, StopReason& reason);

  // No plan that is still to be found costs less.
  double bound() const;

  std::size_t memory() const;

  // The cost can fall for ever: there is no optimum.
  bool unbounded() const { return unbounded_; }

 private:
  struct Entry {
    double key;         // cost, or weighted cost
    double tie;         // steps with their bound
    double cost_bound;  // admissible, for pruning when popped
    std::uint32_t node;
    std::uint32_t steps;  // of the node when pushed: tells outdated entries
    double cost;
    bool operator>(const Entry& other) const {
      if (key != other.key) return key > other.key;
      if (tie != other.tie) return tie > other.tie;
      if (steps != other.steps) return steps < other.steps;
      return node > other.node;
    }
  };

  void start();
  void push(std::uint32_t node);
  void push_goal(std::uint32_t node);
  bool worth(double cost_bound, double steps_bound) const;
  void expand(std::uint32_t node);
  void successor(std::uint32_t parent, int op, double cost);
  bool on_path(std::uint32_t node, std::uint32_t ancestor) const;

  const StateSpace& space_;
  SearchControl& control_;
  const LowerBounds& bounds_;
  double weight_;
  RelaxedPlan heuristic_;
  NodeStore nodes_;
  std::vector<Entry> open_;
  std::vector<Word> scratch_;
  std::vector<Word> current_;
  std::vector<int> applicable_;
  double least_potential_;
  double step_price_ =
      0.0;  // of one step in the weighted key, so that free actions are not free to the search
  bool negative_ = false;
  bool started_ = false;
  bool improved_ = false;
  bool unbounded_ = false;
};

}  // namespace stepwright::pddl

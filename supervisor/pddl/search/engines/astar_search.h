#pragma once

// A* in the lexicographic order (cost, number of steps): the proof.
//
// Costs may depend on the state: they are differences of the metric between two states. What the metric
// accumulates never falls as long as no operator's accumulated cost can be negative (an interval over all
// reachable states says so); then accumulated + bound + least potential bounds every plan through a state
// from below. If some can be negative there is no such bound: the search then visits every reachable state,
// reopening those that a cheaper way reaches, and only its end is a proof. A cycle of falling cost would make
// that endless; it is recognized when a state is reached again from itself at less cost.
//
// Dearer bounds are asked one after the other for the states whose turn it is, each time that the state comes
// up again. What a bound says of a state holds of its successors too; where the state's plans cost more once
// they apply an operator that the bound has not paid for, the successor by that operator costs as much more.
//
// States that others make needless (dominance) are not expanded, and of operators whose order does not matter
// only some orders are looked at (stubborn_sets).
//
// Thread rule: one call, one object. `run` can be resumed after it returned Running.

#include <memory>

#include "supervisor/pddl/search/bounds/lower_bounds.h"
#include "supervisor/pddl/search/control/search_control.h"
#include "supervisor/pddl/search/lp/lp_bound.h"
#include "supervisor/pddl/search/pruning/dominance.h"
#include "supervisor/pddl/search/pruning/stubborn_sets.h"
#include "supervisor/pddl/search/space/state_table.h"

namespace stepwright::pddl {

// Bounds that are dearer than the first; null: not asked. One of the first two at most.
struct DearBounds {
  LandmarkCut* cut = nullptr;
  LpBound* lp = nullptr;
  LpBound* steps = nullptr;  // counts the steps where the cost can no longer tell

  bool any() const { return cut != nullptr || lp != nullptr; }
};

class AStarSearch {
 public:
  AStarSearch(const StateSpace& space, SearchControl& control, const LowerBounds& bounds,
              const DearBounds& dear);

  // Expands at most `expansions` states. Exhausted: no better plan than the control's best exists. Stopped:
  // see `reason`. Better plans are offered to the control on the way.
  SearchStatus run(std::uint64_t expansions, StopReason& reason);

  // No plan that is still to be found costs less.
  double bound();

  // The cost can fall for ever: there is no optimum.
  bool unbounded() const { return unbounded_; }

 private:
  struct Entry {
    double key;  // bound of the cost
    double tie;  // bound of the steps
    std::uint32_t node;
    std::uint32_t steps;  // of the node when pushed: tells outdated entries
    double cost;
    std::uint8_t asked;  // so many of the dear bounds
    bool operator>(const Entry& other) const {
      if (key != other.key) return key > other.key;
      if (tie != other.tie) return tie > other.tie;
      if (steps != other.steps) return steps < other.steps;
      return node > other.node;
    }
  };

  void start();
  void push(std::uint32_t node, const Word* state, double cost);
  void push(const Entry& entry);
  void ask(Entry& entry);
  void ask_for_steps(Entry& entry);
  bool refine(Entry& entry);
  double key_through(std::uint32_t parent, int op, double cost) const;
  void ask_again(std::uint32_t node);
  void offer_goal(std::uint32_t node, const Word* state);
  void expand(const Entry& entry);
  void successor(std::uint32_t parent, int op, double cost);
  bool needless(std::uint32_t node);
  std::size_t memory() const;
  bool on_path(std::uint32_t node, std::uint32_t ancestor) const;

  const StateSpace& space_;
  SearchControl& control_;
  const LowerBounds& bounds_;
  const DearBounds dear_;
  BestKnown best_;
  MemoryShare memory_;
  StateTable nodes_;
  std::unique_ptr<Dominance> dominance_;    // null: no state makes another one needless
  std::unique_ptr<StubbornSets> stubborn_;  // null: every order of operators is looked at
  std::vector<Entry> open_;
  std::vector<Word> scratch_;
  std::vector<Word> current_;
  std::vector<int> applicable_;
  double least_potential_;
  std::vector<double> least_costs_;     // by operator, as the dear bounds count them
  double parent_key_ = -kInfinity;      // of the state that is being expanded
  std::uint64_t successors_ = 0;        // since the control was asked
  std::uint32_t asked_node_ = kNoNode;  // whose plans the dear bounds were asked about last
  bool unit_cost_ = false;              // costs are steps
  bool negative_ = false;
  bool started_ = false;
  bool unbounded_ = false;
};

}  // namespace stepwright::pddl

#pragma once

// Best-first search with deferred evaluation: successors wait under their parent's estimate and are evaluated
// when their turn comes. Several heuristics take turns, each with a queue for all operators and one for the
// preferred ones, which is served more often after progress (Richter, Helmert 2009, "Preferred operators and
// deferred evaluation in satisficing planning"). Greedy with weight 0, for the first plan; else weighted A*,
// for a better one. What cannot beat the best plan known is left out.
//
// Complete: without a better plan in a finite space it ends with Exhausted, which is a proof.
//
// Thread rule: one call, one object. `run` can be resumed after Running.

#include <memory>
#include <optional>
#include <vector>

#include "supervisor/pddl/search/bounds/lower_bounds.h"
#include "supervisor/pddl/search/control/search_control.h"
#include "supervisor/pddl/search/engines/lookahead.h"
#include "supervisor/pddl/search/landmarks/landmark_count.h"
#include "supervisor/pddl/search/pruning/exchange_pruning.h"
#include "supervisor/pddl/search/relaxation/relaxed_plan.h"
#include "supervisor/pddl/search/space/node_words.h"
#include "supervisor/pddl/search/space/state_table.h"

namespace stepwright::pddl {

struct LazyOptions {
  double weight = 0.0;                       // of the estimate against the way so far; 0: greedy
  bool costs = false;                        // estimates of cost instead of steps
  bool lookahead = true;                     // follow relaxed plans
  bool intervals = false;                    // the relaxed plan over intervals as another heuristic
  const Landmarks* landmarks = nullptr;      // counted as another heuristic
  const LowerBounds* bounds = nullptr;       // for pruning
  const Interchangeable* objects = nullptr;  // of states that differ by exchanges one is enough
  std::size_t most_states = SIZE_MAX;        // that it looks ahead to; beyond, it only expands
};

class LazySearch {
 public:
  LazySearch(const RelaxedTask& task, SearchControl& control, const LazyOptions& options);

  // Expands at most so many states. Found: a plan was offered to the control and was better. Exhausted: there
  // is none. Stopped: see `reason`.
  SearchStatus run(std::uint64_t expansions, StopReason& reason);

  std::size_t memory() const { return memory_.bytes(); }

 private:
  struct Entry {
    double key;
    std::uint32_t order;
    std::uint32_t parent;
    std::int32_t op;
    bool operator>(const Entry& other) const {
      return key != other.key ? key > other.key : order > other.order;
    }
  };
  struct Queue {
    std::vector<Entry> heap;
    std::int64_t turns = 0;
    bool preferred = false;
  };
  struct Estimate {
    int value = 0;
    int best = INT32_MAX;
  };

  void start();
  bool pop(Entry& entry);
  bool leads_through(std::uint32_t node, std::uint32_t end) const;
  std::uint32_t generate(const Entry& entry);
  bool worth(std::uint32_t node, const Word* state);
  bool reached(std::uint32_t node, const Word* state);
  void expand(std::uint32_t node);
  bool evaluate(std::uint32_t node);
  void push_successors(std::uint32_t node);
  void mark_preferred(std::uint32_t node);
  bool look_ahead(std::uint32_t& node);
  double key(std::uint32_t node, int estimate) const;
  std::size_t bytes() const;

  const RelaxedTask& task_;
  const StateSpace& space_;
  SearchControl& control_;
  LazyOptions options_;
  BestKnown best_;
  MemoryShare memory_;
  OperatorWeights weights_;
  double least_potential_;
  AdditiveHeuristic additive_;
  std::optional<RelaxedPlan> intervals_;
  std::optional<LandmarkCount> count_;
  std::optional<ExchangePruning> exchanges_;
  Lookahead lookahead_;
  bool costs_can_fall_;
  StateTable nodes_;
  NodeWords reached_;
  std::vector<Estimate> estimates_;
  std::vector<Queue> queues_;  // two for every estimate
  std::vector<Word> state_, ahead_, scratch_;
  std::vector<int> applicable_;
  std::vector<std::uint32_t> preferred_;  // expansion in which the operator was preferred
  std::uint32_t expansion_ = 0;
  std::uint32_t order_ = 0;
  bool started_ = false;
  bool improved_ = false;
};

}  // namespace stepwright::pddl

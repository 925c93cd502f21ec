#pragma once

// A cheaper way from one state of a plan to another that serves the rest of the plan as well: A* with a
// relaxed plan's cost as the estimate, limited by what the plan itself pays for that part. A state waits with
// what its parent's relaxed plan lets expect of it, and is only evaluated when its turn comes (Richter,
// Helmert 2009, "Preferred operators and deferred evaluation in satisficing planning"): most never are.
//
// Thread rule: one search, one object: it reuses its memory.

#include <optional>
#include <vector>

#include "supervisor/pddl/search/control/search_control.h"
#include "supervisor/pddl/search/improvement/plan_needs.h"
#include "supervisor/pddl/search/relaxation/additive_heuristic.h"
#include "supervisor/pddl/search/space/state_table.h"

namespace stepwright::pddl {

class WindowSearch {
 public:
  WindowSearch(const RelaxedTask& task, SearchControl& control);

  struct Window {
    const Word* from;
    const Word* to;          // the plan's own state after the window
    const PlanNeeds* needs;  // of the rest of the plan
    double cost = 0.0;       // of the window's part of the plan
    std::uint32_t steps = 0;
  };

  // Operators that are cheaper, or as cheap and fewer. Counts `evaluations` down and gives up at `least`.
  std::optional<std::vector<int>> improve(const Window& window, std::int64_t& evaluations,
                                          std::int64_t least);

 private:
  struct Entry {
    double key;
    std::uint32_t order;
    std::uint32_t node;
    double cost;     // of the way when it was entered
    bool evaluated;  // else the estimate is one by the parent
    bool operator>(const Entry& other) const {
      return key != other.key ? key > other.key : order > other.order;
    }
  };

  void aim(const Window& window);
  bool arrived(const Word* state) const;
  void push(std::uint32_t node, double estimate, bool evaluated);
  bool evaluate(std::uint32_t node);
  void expand(std::uint32_t node, const Quality& limit);

  const RelaxedTask& task_;
  const StateSpace& space_;
  SearchControl& control_;
  OperatorWeights weights_;
  AdditiveHeuristic heuristic_;
  std::vector<int> literals_;
  std::vector<Comparison> comparisons_;
  StateTable nodes_;
  std::vector<Entry> open_;
  std::vector<Word> state_, next_;
  std::vector<int> applicable_;
  struct Estimate {
    int value = 0;
    std::vector<int> helpful;
  };
  std::vector<Estimate> estimates_;     // by node
  std::vector<std::uint32_t> helpful_;  // expansion in which the operator was helpful
  std::uint32_t expansion_ = 0;
  std::int64_t generated_ = 0;
  std::uint32_t order_ = 0;
};

}  // namespace stepwright::pddl

#pragma once

// A cheaper way from one state of a plan to another that serves the rest of the plan as well: A* with a
// relaxed plan's cost as the estimate, limited by what the plan itself pays for that part.
//
// Thread rule: one search, one object: it reuses its memory.

#include <optional>
#include <vector>

#include "supervisor/pddl/search/additive_heuristic.h"
#include "supervisor/pddl/search/plan_needs.h"
#include "supervisor/pddl/search/search_control.h"
#include "supervisor/pddl/search/state_table.h"

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
    bool operator>(const Entry& other) const {
      return key != other.key ? key > other.key : order > other.order;
    }
  };

  void aim(const Window& window);
  bool arrived(const Word* state) const;
  void push(std::uint32_t node, const Word* state);

  const RelaxedTask& task_;
  const StateSpace& space_;
  SearchControl& control_;
  AdditiveHeuristic heuristic_;
  double scale_;  // what a cost of one counts in estimates
  std::vector<int> literals_;
  std::vector<Comparison> comparisons_;
  StateTable nodes_;
  std::vector<Entry> open_;
  std::vector<Word> state_, next_;
  std::vector<int> applicable_;
  std::uint32_t order_ = 0;
};

}  // namespace stepwright::pddl

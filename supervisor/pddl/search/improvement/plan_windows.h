#pragma once

// Better plans by better parts: windows of a plan are planned anew wherever the rest of the plan allows it
// (Siddiqui, Haslum 2015, "Continuing plan quality optimisation"). Two kinds take turns: parts of the plan as
// it stands, small ones first, after operators that work towards each other were moved next to each other;
// and operators from anywhere in the plan that have something to do with each other, gathered as far as its
// partial order allows.
//
// Thread rule: one call, one object. It goes on where it stopped, and starts anew when there is a better
// plan. The same plans give the same windows.

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "supervisor/pddl/search/improvement/plan_order.h"
#include "supervisor/pddl/search/improvement/window_search.h"

namespace stepwright::pddl {

class PlanWindows {
 public:
  PlanWindows(const RelaxedTask& task, SearchControl& control)
      : space_(task.space()), control_(control), search_(task, control) {}

  // Spends about so many evaluations; better plans are offered to the control. False if the control says
  // stop.
  bool run(std::int64_t evaluations, StopReason& reason);

 private:
  // A plan with the states and the accumulated costs along it.
  struct Trace {
    std::vector<int> plan;
    std::vector<std::vector<Word>> states;
    std::vector<double> costs;
  };

  bool follow(std::vector<int> plan, Trace& trace) const;
  bool start();
  void slide(std::int64_t& evaluations);
  void gather(std::int64_t& evaluations);
  void drop(std::int64_t& evaluations);
  std::vector<std::size_t> related(std::size_t size, bool closed);
  std::vector<std::size_t> with_object();
  bool know_order();
  void accept(std::vector<int> plan);
  std::size_t companion(std::size_t position);
  void improve(const Trace& trace, std::size_t first, std::size_t last, std::int64_t& evaluations);

  const StateSpace& space_;
  SearchControl& control_;
  WindowSearch search_;
  std::uint64_t version_ = 0;  // of the best plan when it was taken
  Trace trace_;
  std::size_t first_ = 0;  // of the window of the plan as it stands that is next
  std::size_t length_ = 0;
  std::int64_t effort_ = 0;                          // evaluations for one window
  std::optional<PlanOrder> order_;                   // none: worked out when it is needed
  std::vector<std::vector<std::size_t>> by_object_;  // positions of the operators with that argument
  std::minstd_rand random_{1};
};

}  // namespace stepwright::pddl

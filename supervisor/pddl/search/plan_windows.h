#pragma once

// Better plans by better parts: windows of a plan are planned anew, small ones first, wherever the rest of
// the plan allows it (Siddiqui, Haslum 2015, "Continuing plan quality optimisation"). Before that, operators
// that work towards each other are moved next to each other, so that a window holds what belongs together.
//
// Thread rule: one call, one object. It goes on where it stopped, and starts anew when there is a better
// plan.

#include <cstdint>
#include <vector>

#include "supervisor/pddl/search/window_search.h"

namespace stepwright::pddl {

class PlanWindows {
 public:
  PlanWindows(const RelaxedTask& task, SearchControl& control)
      : space_(task.space()), control_(control), search_(task, control) {}

  // Spends about so many evaluations; better plans are offered to the control. False if the control says
  // stop.
  bool run(std::int64_t evaluations, StopReason& reason);

 private:
  bool take(std::vector<int> plan);
  void next_window();
  PlanNeeds needs_after(std::size_t step) const;
  void improve(std::size_t last, std::int64_t& evaluations);

  const StateSpace& space_;
  SearchControl& control_;
  WindowSearch search_;
  std::uint64_t version_ = 0;  // of the best plan when it was taken
  std::vector<int> plan_;
  std::vector<std::vector<Word>> states_;  // along the plan
  std::vector<double> costs_;              // accumulated there
  std::size_t first_ = 0;                  // of the window that is next
  std::size_t length_ = 0;
  std::int64_t effort_ = 0;  // evaluations for one window
};

}  // namespace stepwright::pddl

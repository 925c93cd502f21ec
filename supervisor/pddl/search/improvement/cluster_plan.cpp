#include "supervisor/pddl/search/improvement/cluster_plan.h"

#include "supervisor/pddl/search/control/plan_runner.h"
#include "supervisor/pddl/search/improvement/plan_order.h"

namespace stepwright::pddl {

// Always goes on with what the operator placed last has set free, if there is any.
std::vector<int> cluster_plan(const StateSpace& space, const std::vector<int>& plan) {
  if (!space.task().axioms.empty()) return plan;
  const auto after = orderings(space.task(), plan);
  std::vector<std::vector<std::size_t>> before(plan.size());
  std::vector<std::size_t> missing(plan.size(), 0);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    missing[i] = after[i].size();
    for (const std::size_t earlier : after[i]) before[earlier].push_back(i);
  }
  std::vector<int> order;
  std::vector<std::size_t> ready;
  for (std::size_t i = plan.size(); i > 0; --i) {
    if (missing[i - 1] == 0) ready.push_back(i - 1);
  }
  while (!ready.empty()) {
    const std::size_t next = ready.back();
    ready.pop_back();
    order.push_back(plan[next]);
    for (auto later = before[next].rbegin(); later != before[next].rend(); ++later) {
      if (--missing[*later] == 0) ready.push_back(*later);
    }
  }
  return cost_of_plan(space, order) < kInfinity ? order : plan;
}

}  // namespace stepwright::pddl

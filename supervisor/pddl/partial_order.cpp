#include "supervisor/pddl/partial_order.h"

#include <algorithm>

#include "supervisor/pddl/ground_action.h"

namespace stepwright::pddl {
namespace {

bool intersects(const std::set<std::string>& a, const std::set<std::string>& b) {
  return std::any_of(a.begin(), a.end(), [&](const std::string& name) { return b.count(name) != 0; });
}

bool interfere(const GroundActionInfo& a, const GroundActionInfo& b) {
  if (intersects(a.writes, b.reads) || intersects(a.reads, b.writes)) return true;
  return std::any_of(a.writes.begin(), a.writes.end(), [&](const std::string& name) {
    return b.writes.count(name) != 0 && !(a.counts.count(name) != 0 && b.counts.count(name) != 0);
  });
}

}  // namespace

result::Result<std::vector<model::Ordering>> lift_partial_order(const Task& task, const model::Plan& plan) {
  const std::size_t count = plan.actions.size();
  std::vector<GroundActionInfo> infos;
  for (const model::GroundAction& action : plan.actions) {
    auto info = inspect_action(task, action);
    if (!info) return result::forward(info);
    infos.push_back(std::move(*info));
  }
  // before[j][i]: i comes before j. Walking i downwards from j, a pair that is implied by a later one is left
  // out.
  std::vector<std::vector<bool>> before(count, std::vector<bool>(count, false));
  std::vector<model::Ordering> orderings;
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t i = j; i-- > 0;) {
      if (before[j][i] || !interfere(infos[i], infos[j])) continue;
      orderings.push_back({i, j});
      before[j][i] = true;
      for (std::size_t k = 0; k < i; ++k) {
        if (before[i][k]) before[j][k] = true;
      }
    }
  }
  std::sort(orderings.begin(), orderings.end(), [](const model::Ordering& a, const model::Ordering& b) {
    return a.before != b.before ? a.before < b.before : a.after < b.after;
  });
  return orderings;
}

}  // namespace stepwright::pddl

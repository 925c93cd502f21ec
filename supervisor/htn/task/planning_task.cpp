#include "supervisor/htn/task/planning_task.h"

#include <algorithm>

namespace stepwright::htn {

bool PlanningTask::is_of_type(int object, int type) const {
  const std::vector<bool>& below = types[static_cast<std::size_t>(type)].below;
  const std::vector<int>& own = objects[static_cast<std::size_t>(object)].types;
  return std::ranges::any_of(own, [&](int declared) { return below[static_cast<std::size_t>(declared)]; });
}

bool PlanningTask::is_subtype(int type, int of) const {
  const std::vector<bool>& a = types[static_cast<std::size_t>(type)].below;
  const std::vector<bool>& b = types[static_cast<std::size_t>(of)].below;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] && !b[i]) return false;
  return true;
}

bool PlanningTask::overlap(int type, int other) const {
  const std::vector<bool>& a = types[static_cast<std::size_t>(type)].below;
  const std::vector<bool>& b = types[static_cast<std::size_t>(other)].below;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] && b[i]) return true;
  return false;
}

}  // namespace stepwright::htn

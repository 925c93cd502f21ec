// The plan that the frames and actions of a search say.

#include <algorithm>
#include <cstdint>

#include "supervisor/htn/search/search_engine.h"

namespace stepwright::htn {

Plan Search::Implementation::build_plan() const {
  // A task that comes next, and the node that it is under.
  struct Pending {
    int ground = 0;
    std::size_t parent = 0;
  };
  Plan plan;
  const auto name_of = [&](int object) { return task_.objects[static_cast<std::size_t>(object)].name; };
  const auto actions = static_cast<int>(task_.actions.size());
  std::vector<Pending> pending;
  std::size_t next_frame = 0;
  const auto expand = [&](std::size_t node) {
    const Frame& frame = frames_[next_frame++];
    const Method& method = task_.methods[static_cast<std::size_t>(frame.chosen_method)];
    const std::size_t count = method.subtasks.size();
    std::vector<std::string> binding;
    for (std::size_t i = 0; i < method.parameters.size(); ++i)
      binding.push_back(name_of(frame.walk.binding()[i]));
    if (next_frame == 1) {
      plan.binding = std::move(binding);
    } else {
      plan.nodes[node].method = method.name;
      plan.nodes[node].binding = std::move(binding);
    }
    const std::size_t first = pending.size();
    int network = frame.chosen;
    for (std::size_t i = 0; i < count; ++i, network = agenda_.rest(network))
      pending.push_back({agenda_.task(network), node});
    std::reverse(pending.begin() + static_cast<std::ptrdiff_t>(first), pending.end());
  };
  const std::size_t no_parent = SIZE_MAX;
  expand(no_parent);
  while (!pending.empty()) {
    const Pending now = pending.back();
    pending.pop_back();
    const std::size_t node = plan.nodes.size();
    (now.parent == no_parent ? plan.roots : plan.nodes[now.parent].children).push_back(node);
    const int head = tuples_.head(now.ground);
    plan.nodes.emplace_back();
    for (const int object : tuples_.objects(now.ground))
      plan.nodes[node].arguments.push_back(name_of(object));
    if (head >= actions) {
      plan.nodes[node].name = task_.tasks[static_cast<std::size_t>(head - actions)].name;
      expand(node);
      continue;
    }
    plan.nodes[node].name = task_.actions[static_cast<std::size_t>(head)].name;
    plan.steps.push_back(node);
  }
  for (const AppliedAction& applied : applied_) plan.cost += actions_.cost(applied.ground);
  return plan;
}

}  // namespace stepwright::htn

#include "runtime/host/task_plan.h"

#include <algorithm>
#include <set>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::host {
namespace {

// Events may be more urgent than what is cyclic, but only a cyclic task (or one that never rests) can lead:
// commands and inputs must be looked at again and again.
std::uint32_t leader_of(std::span<const reader::TaskInfo> tasks) {
  const auto rank = [&](std::uint32_t i) {
    const reader::TaskInfo& task = tasks[i];
    const int kind = task.interval_us > 0 && task.trigger.empty() ? 0 : task.interval_us > 0 ? 1 : 2;
    return std::pair(task.interval_us == 0 && !task.trigger.empty() ? 3 : kind, task.priority);
  };
  std::uint32_t leader = 0;
  for (std::uint32_t i = 1; i < tasks.size(); ++i) {
    if (rank(i) < rank(leader)) leader = i;
  }
  return leader;
}

}  // namespace

std::vector<std::uint32_t> TaskPlan::others() const {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < tasks.size(); ++i) {
    if (((own_tasks >> i) & 1u) == 0) out.push_back(i);
  }
  return out;
}

TaskPlan plan_tasks(std::span<const reader::TaskInfo> tasks, const HostConfig& config) {
  TaskPlan plan;
  std::set<std::uint32_t> priorities;
  for (const reader::TaskInfo& task : tasks) priorities.insert(task.priority);
  for (const reader::TaskInfo& task : tasks) {
    TaskPlan::Entry entry{task.name, task.interval_us, task.priority, {}};
    entry.placement.rank =
        static_cast<int>(std::distance(priorities.begin(), priorities.find(task.priority)));
    entry.placement.background = task.interval_us == 0 && task.trigger.empty();
    entry.placement.cpu = config.cpu;
    scan::TaskOptions options;
    // In simulated time nothing depends on how long the machine takes.
    if (config.clock == ClockMode::Real) options.watchdog = config.safety.watchdog_of(task.name);
    for (const TaskSettings& settings : config.tasks) {
      if (!naming::same_name(settings.name, task.name)) continue;
      options.overrun = settings.overrun;
      options.phase_ns = settings.phase_ns;
      if (settings.cpu >= 0) entry.placement.cpu = settings.cpu;
      const std::int64_t interval_ns = std::int64_t{task.interval_us} * 1'000;
      options.phase_ns = interval_ns > 0 ? options.phase_ns % interval_ns : 0;
    }
    plan.tasks.push_back(std::move(entry));
    plan.options.push_back(options);
  }
  for (const TaskSettings& settings : config.tasks) {
    const bool known = std::any_of(plan.tasks.begin(), plan.tasks.end(), [&](const TaskPlan::Entry& entry) {
      return naming::same_name(entry.name, settings.name);
    });
    if (known) continue;
    plan.unknown += (plan.unknown.empty() ? "no task is called " : ", ") + settings.name;
  }
  plan.leader = leader_of(tasks);
  plan.own_tasks = config.clock == ClockMode::Real ? 1u << plan.leader : 0xFFFF'FFFFu;
  return plan;
}

}  // namespace stepwright::host

#include "supervisor/translate/schedule.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "supervisor/translate/plan_graph.h"

namespace stepwright::translate {

namespace {

double seconds(milliseconds time) {
  return std::chrono::duration<double>(time).count();
}

result::Result<double> nominal_duration(const model::PlannedAction& planned, const Binding& binding) {
  Assignment assignment;
  const ActionBinding& entry = *binding.action_for(planned.action, assignment);
  double duration = entry.duration.fixed_s + seconds(entry.rest);
  if (!entry.duration.of) return duration;
  const std::string fluent = instantiate(*entry.duration.of, assignment);
  const auto before = planned.before.fluents.find(fluent);
  const auto after = planned.after.fluents.find(fluent);
  if (before == planned.before.fluents.end() || after == planned.after.fluents.end()) {
    return result::fail("T0003", entry.where,
                        "the duration of " + to_string(planned.action) + " counts " + fluent +
                            ", which the plan's states lack");
  }
  const double change = std::abs(after->second - before->second);
  duration += entry.duration.per_unit_s * (change != 0.0 ? change : std::abs(after->second));
  return duration;
}

}  // namespace

result::Result<Schedule> schedule(const model::PlannedRun& run, const Binding& binding, bool sequential) {
  auto graph = plan_graph(run, binding, sequential);
  if (!graph) return result::forward(graph);
  Schedule schedule;
  double last = seconds(binding.start);
  for (std::size_t i = 0; i < run.actions.size(); ++i) {
    auto duration = nominal_duration(run.actions[i], binding);
    if (!duration) return result::forward(duration);
    ScheduledAction times{seconds(binding.start), 0.0};
    for (const std::size_t before : graph->predecessors[i]) {
      times.start_s = std::max(times.start_s, schedule.actions[before].finish_s);
    }
    times.finish_s = times.start_s + *duration;
    last = std::max(last, times.finish_s);
    schedule.actions.push_back(times);
  }
  schedule.makespan_s = last + seconds(binding.settle);
  return schedule;
}

}  // namespace stepwright::translate

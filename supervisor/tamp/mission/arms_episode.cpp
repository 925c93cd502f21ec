#include "supervisor/tamp/mission/arms_episode.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace stepwright::tamp::mission {
namespace {

constexpr double kNever_s = std::numeric_limits<double>::max();

void add_times(const PreparedArms& prepared, std::vector<run::ActionRecord>& actions) {
  for (const schedule::ArmSchedule& arm : prepared.schedule.arms)
    for (const schedule::ScheduledStep& step : arm.steps) {
      run::ActionRecord& action = actions[step.action];
      action.planned_start_s = std::min(action.planned_start_s, step.start_s);
      action.planned_finish_s = std::max(action.planned_finish_s, step.finish_s);
      action.planned_cost += step.duration_s;
    }
}

// The first step of the program for each action.
void add_steps(const PreparedArms& prepared, std::vector<run::ActionRecord>& actions) {
  for (const program::ArmsStep& step : prepared.program.steps)
    if (step.arm >= 0 && step.kind != program::ArmsStepKind::Start &&
        step.kind != program::ArmsStepKind::Done && step.action < actions.size() &&
        actions[step.action].step.empty())
      actions[step.action].step = step.name;
}

}  // namespace

run::Episode episode_of(const PreparedArms& prepared) {
  run::Episode episode;
  episode.first_plan_ms = prepared.spent_ms;
  episode.planned_makespan_s = prepared.schedule.makespan_s;
  episode.planned_sequential_makespan_s = prepared.schedule.sequential_s;
  episode.cost = prepared.schedule.makespan_s;
  for (const scene::PlannedAction& each : prepared.plan.actions) {
    run::ActionRecord action;
    action.text = text_of(*prepared.cell, each.what);
    action.planned_start_s = kNever_s;
    episode.actions.push_back(std::move(action));
  }
  add_times(prepared, episode.actions);
  add_steps(prepared, episode.actions);
  for (run::ActionRecord& action : episode.actions)
    if (action.planned_start_s == kNever_s) {
      action.planned_start_s = action.planned_finish_s = 0.0;
      action.state = run::ActionState::Done;
    }
  return episode;
}

}  // namespace stepwright::tamp::mission

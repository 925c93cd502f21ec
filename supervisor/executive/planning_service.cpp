#include "supervisor/executive/planning_service.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "ladder/driver/compile.h"
#include "supervisor/executive/action_cost.h"
#include "supervisor/pddl/plan/describe_run.h"
#include "supervisor/pddl/plan/partial_order.h"
#include "supervisor/pddl/plan/simulate.h"
#include "supervisor/pddl/planner/repair.h"
#include "supervisor/pddl/planner/solve.h"
#include "supervisor/pddl/task/goal_vocabulary.h"
#include "supervisor/pddl/task/vocabulary.h"
#include "supervisor/translate/observe_program.h"

namespace stepwright::executive {
namespace {

result::Result<void> compile_project(const graphic::Project& project, const HandWritten& programs,
                                     const PlanningOptions& options,
                                     std::span<const driver::Watcher> watchers, PreparedPlan& prepared) {
  auto joined = programs.joined(project);
  if (!joined) return tl::unexpected(std::move(joined.error()));
  auto output = driver::compile({.texts = {},
                                 .projects = joined->projects(),
                                 .document = options.document,
                                 .dialect = options.dialect,
                                 .watchers = watchers});
  if (!output) return tl::unexpected(std::move(output.error()));
  prepared.container = std::move(output->container);
  return {};
}

// The figures of an episode that follow from plan and binding alone.
result::Result<void> fill_schedule(PreparedPlan& prepared, const translate::Binding& binding,
                                   bool sequential) {
  auto parallel = translate::schedule(prepared.run, binding, false);
  if (!parallel) return tl::unexpected(std::move(parallel.error()));
  auto strict = translate::schedule(prepared.run, binding, true);
  if (!strict) return tl::unexpected(std::move(strict.error()));
  prepared.episode.planned_makespan_s = parallel->makespan_s;
  prepared.episode.planned_sequential_makespan_s = strict->makespan_s;
  const translate::Schedule& used = sequential ? *strict : *parallel;
  for (std::size_t i = 0; i < used.actions.size(); ++i) {
    prepared.episode.actions[i].planned_start_s = used.actions[i].start_s;
    prepared.episode.actions[i].planned_finish_s = used.actions[i].finish_s;
  }
  return {};
}

PrepareStatus status_of(const model::Outcome& outcome) {
  if (outcome.kind == model::OutcomeKind::Cancelled) return PrepareStatus::Cancelled;
  if (outcome.plan) return PrepareStatus::Ready;
  return outcome.kind == model::OutcomeKind::Infeasible ? PrepareStatus::Infeasible
                                                        : PrepareStatus::Exhausted;
}

// The conjuncts of the goal that cannot be reached, each by itself: ", so (is-at v1 f1) cannot be reached".
// Empty if it is only together that they cannot.
std::string out_of_reach(const pddl::Task& task, pddl::Options options) {
  // A budget for each; what is not proved within it is not said.
  constexpr int kPart = 20;
  std::string names;
  const auto goals = pddl::evaluate_goal(task, task.initial());
  if (!goals) return {};
  options.first_only = true;
  options.optimal = false;
  options.budget.time /= kPart;
  for (const pddl::GoalStatus& goal : *goals) {
    if (goal.met) continue;
    const auto alone = task.with_goal(goal.text);
    if (!alone || pddl::solve(*alone, options).kind != model::OutcomeKind::Infeasible) continue;
    names += (names.empty() ? "" : " and ") + goal.text;
  }
  return names.empty() ? names : ", so " + names + " cannot be reached";
}

}  // namespace

PlanningService::PlanningService(PlanningOptions options, pddl::Task task, translate::Binding binding,
                                 HandWritten programs)
    : options_(std::move(options)),
      task_(std::move(task)),
      binding_(std::move(binding)),
      programs_(std::move(programs)) {}

result::Result<PlanningService> PlanningService::open(const PlanningOptions& options) {
  auto task = pddl::load_task(options.domain.string(), options.problem.string());
  if (!task) return result::forward(task);
  const model::Vocabulary vocabulary = pddl::vocabulary(*task);
  auto binding = translate::load_binding(options.binding, &vocabulary);
  if (!binding) return result::forward(binding);
  auto programs = HandWritten::load(options.programs, *options.dialect);
  if (!programs) return result::forward(programs);
  PlanningService service(options, std::move(*task), std::move(*binding), std::move(*programs));
  service.find_resting_watchers();
  return service;
}

// One that reads tags of a plan cannot be compiled with a program that has none.
void PlanningService::find_resting_watchers() {
  if (options_.watchers.empty()) return;
  const translate::Translation look =
      translate::observe_program(binding_, {.interval_us = options_.interval_us});
  const auto compiles = [&](std::span<const driver::Watcher> watchers) {
    PreparedPlan tried;
    return compile_project(look.project, programs_, options_, watchers, tried).has_value();
  };
  if (compiles(options_.watchers)) {
    resting_watchers_ = options_.watchers;
    return;
  }
  for (const driver::Watcher& each : options_.watchers)
    if (compiles(std::span(&each, 1))) resting_watchers_.push_back(each);
}

result::Result<pddl::Task> PlanningService::task_for(const StartState& start) const {
  auto task = task_.with_initial(pddl::from_named(start.planning));
  if (!task || start.goal.empty()) return task;
  return task->with_goal(start.goal);
}

result::Result<PrepareOutcome> PlanningService::prepare(const PlanRequest& request) const {
  auto task = task_for(request.start);
  if (!task) return result::forward(task);
  auto outcome = plan_for(request, *task);
  if (!outcome || outcome->status != PrepareStatus::Ready) return outcome;
  if (auto built = build(outcome->prepared, *task); !built) return tl::unexpected(std::move(built.error()));
  return outcome;
}

result::Result<PrepareOutcome> PlanningService::sketch(const PlanRequest& request) const {
  auto task = task_for(request.start);
  if (!task) return result::forward(task);
  auto outcome = plan_for(request, *task);
  if (!outcome || outcome->status != PrepareStatus::Ready) return outcome;
  PreparedPlan& prepared = outcome->prepared;
  if (auto told = describe(prepared, *task); !told) return tl::unexpected(std::move(told.error()));
  if (auto scheduled = fill_schedule(prepared, binding_, options_.sequential); !scheduled)
    return tl::unexpected(std::move(scheduled.error()));
  return outcome;
}

result::Result<PlanWorth> PlanningService::worth_of(const StartState& start,
                                                    const std::vector<model::GroundAction>& actions) const {
  auto task = task_for(start);
  if (!task) return result::forward(task);
  PreparedPlan prepared;
  prepared.plan.actions = actions;
  if (auto told = describe(prepared, *task); !told) return tl::unexpected(std::move(told.error()));
  const auto before = pddl::evaluate_metric(*task, task->initial(), 0);
  if (!before) return tl::unexpected(before.error());
  const auto after = pddl::state_after(*task, prepared.plan);
  if (!after) return tl::unexpected(after.error());
  const auto cost = pddl::evaluate_metric(*task, *after, actions.size());
  if (!cost) return tl::unexpected(cost.error());
  const auto schedule = translate::schedule(prepared.run, binding_, options_.sequential);
  if (!schedule) return tl::unexpected(schedule.error());
  return PlanWorth{*cost, *before, schedule->makespan_s};
}

// The plan and its figures; neither its actions' records nor its program.
result::Result<PrepareOutcome> PlanningService::plan_for(const PlanRequest& request,
                                                         const pddl::Task& task) const {
  pddl::RepairOptions options;
  options.search.optimal = options_.optimal;
  options.search.budget = request.budget;
  if (options.search.budget.time.count() == 0) options.search.budget.time = options_.time;
  options.search.cancel = request.cancel;
  if (!request.without.empty()) {
    options.search.excluded = [&](const model::GroundAction& action) {
      const std::vector<std::string> needed = binding_.devices_of(action);
      return std::any_of(needed.begin(), needed.end(),
                         [&](const std::string& device) { return request.without.contains(device); });
    };
  }
  const pddl::RepairOutcome mended = pddl::repair(task, request.remaining, options);
  const model::Outcome& solved = mended.outcome;
  PrepareOutcome outcome;
  outcome.reason = solved.reason;
  outcome.status = status_of(solved);
  if (outcome.status == PrepareStatus::Infeasible && !request.without.empty())
    outcome.reason += out_of_reach(task, options.search);
  if (outcome.status != PrepareStatus::Ready) return outcome;
  PreparedPlan& prepared = outcome.prepared;
  prepared.start = request.start;
  prepared.plan = *solved.plan;
  if (auto ordered = order_for_makespan(prepared.plan, task); !ordered)
    return tl::unexpected(std::move(ordered.error()));
  run::Episode& episode = prepared.episode;
  episode.cost = solved.plan->cost;
  if (std::isfinite(solved.plan->bound)) episode.bound = solved.plan->bound;
  episode.proved_optimal = solved.plan->proved_optimal;
  episode.first_plan_ms = solved.first_plan_ms;
  episode.optimal_plan_ms = solved.wall_ms;
  episode.origin = request.remaining.empty() ? "planned" : to_string(mended.kind);
  episode.kept = mended.kept;
  episode.remaining = mended.of;
  episode.repair_ms = mended.repair_ms;
  episode.replan_ms = mended.replan_ms;
  return outcome;
}

// Among the orders that the plan allows, that in which outputs that exclude each other cost the least time.
result::Result<void> PlanningService::order_for_makespan(model::Plan& plan, const pddl::Task& task) const {
  if (!plan.orderings || options_.sequential) return {};
  const auto run = pddl::describe_run(task, plan);
  if (!run) return tl::unexpected(run.error());
  const auto order = translate::makespan_order(*run, binding_);
  if (!order) return tl::unexpected(order.error());
  std::vector<std::size_t> place(order->size());
  model::Plan ordered = plan;
  for (std::size_t n = 0; n < order->size(); ++n) {
    place[(*order)[n]] = n;
    ordered.actions[n] = plan.actions[(*order)[n]];
  }
  for (model::Ordering& edge : *ordered.orderings) edge = {place[edge.before], place[edge.after]};
  plan = std::move(ordered);
  return {};
}

result::Result<PreparedPlan> PlanningService::rebuild(const StartState& start,
                                                      const model::Plan& plan) const {
  auto task = task_for(start);
  if (!task) return result::forward(task);
  PreparedPlan prepared;
  prepared.start = start;
  prepared.plan = plan;
  if (auto built = build(prepared, *task); !built) return tl::unexpected(std::move(built.error()));
  return prepared;
}

// The run, and a record of each action.
result::Result<void> PlanningService::describe(PreparedPlan& prepared, const pddl::Task& task) const {
  if (!prepared.plan.orderings) {
    auto orderings = pddl::lift_partial_order(task, prepared.plan);
    if (!orderings) return tl::unexpected(std::move(orderings.error()));
    prepared.plan.orderings = std::move(*orderings);
  }
  auto run = pddl::describe_run(task, prepared.plan);
  if (!run) return tl::unexpected(std::move(run.error()));
  prepared.run = std::move(*run);
  for (const model::PlannedAction& planned : prepared.run.actions) {
    run::ActionRecord record;
    record.text = model::to_string(planned.action);
    record.planned_cost = cost_of(planned.action, planned.before);
    for (const translate::Sensor& sensor : binding_.sensors) {
      const auto value = planned.after.fluents.find(sensor.fluent);
      if (value != planned.after.fluents.end()) record.expected[sensor.fluent] = value->second;
    }
    prepared.episode.actions.push_back(std::move(record));
  }
  return {};
}

result::Result<void> PlanningService::build(PreparedPlan& prepared, const pddl::Task& task) const {
  if (auto told = describe(prepared, task); !told) return told;
  auto translation = translate::translate(prepared.run, binding_,
                                          {.sequential = options_.sequential,
                                           .interval_us = options_.interval_us,
                                           .tare = prepared.start.tare,
                                           .measured = prepared.start.measured,
                                           .monitors = options_.monitors});
  if (!translation) return tl::unexpected(std::move(translation.error()));
  prepared.translation = std::move(*translation);
  for (const translate::StepInfo& step : prepared.translation.steps) {
    if (step.kind == translate::StepKind::Action) prepared.episode.actions[*step.action].step = step.name;
  }
  if (auto scheduled = fill_schedule(prepared, binding_, options_.sequential); !scheduled) return scheduled;
  return compile_project(prepared.translation.project, programs_, options_, options_.watchers, prepared);
}

result::Result<PreparedPlan> PlanningService::observer(bool locate, std::chrono::milliseconds settle) const {
  PreparedPlan prepared;
  translate::ObserveOptions options;
  options.window = settle;
  options.locate = locate;
  options.interval_us = options_.interval_us;
  prepared.translation = translate::observe_program(binding_, options);
  if (auto compiled =
          compile_project(prepared.translation.project, programs_, options_, resting_watchers_, prepared);
      !compiled) {
    return tl::unexpected(std::move(compiled.error()));
  }
  return prepared;
}

double PlanningService::cost_of(const model::GroundAction& action, const model::NamedState& before) const {
  return action_cost(task_, options_.report_fluent, action, before);
}

std::vector<run::GoalRecord> PlanningService::goal_status(const model::NamedState& state,
                                                          const std::string& goal) const {
  std::vector<run::GoalRecord> records;
  auto task = goal.empty() ? result::Result<pddl::Task>(task_) : task_.with_goal(goal);
  if (!task) return records;
  if (auto status = pddl::evaluate_goal(*task, pddl::from_named(state))) {
    for (pddl::GoalStatus& each : *status) records.push_back({std::move(each.text), each.met});
  }
  return records;
}

std::string PlanningService::goal_text(const std::string& goal) const {
  const auto task = goal.empty() ? result::Result<pddl::Task>(task_) : task_.with_goal(goal);
  return task ? pddl::goal_text(task->goals()) : goal;
}

result::Result<void> PlanningService::check_goal(const std::string& goal) const {
  auto task = task_.with_goal(goal);
  if (!task) return result::forward(task);
  return {};
}

}  // namespace stepwright::executive

#include "supervisor/executive/planning_desk.h"

#include <cmath>
#include <utility>

#include "ladder/driver/compile.h"
#include "supervisor/executive/action_cost.h"
#include "supervisor/pddl/describe_run.h"
#include "supervisor/pddl/partial_order.h"
#include "supervisor/pddl/simulate.h"
#include "supervisor/pddl/solve.h"
#include "supervisor/pddl/vocabulary.h"
#include "supervisor/translate/observe_program.h"

namespace stepwright::executive {
namespace {

result::Result<void> compile_project(const graphic::Project& project, const HandWritten& programs,
                                     PreparedPlan& prepared) {
  auto joined = programs.joined(project);
  if (!joined) return tl::unexpected(std::move(joined.error()));
  auto output = driver::compile({.texts = {}, .projects = joined->projects()});
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

}  // namespace

PlanningDesk::PlanningDesk(DeskOptions options, pddl::Task task, translate::Binding binding,
                           HandWritten programs)
    : options_(std::move(options)),
      task_(std::move(task)),
      binding_(std::move(binding)),
      programs_(std::move(programs)) {}

result::Result<PlanningDesk> PlanningDesk::open(const DeskOptions& options) {
  auto task = pddl::load_task(options.domain.string(), options.problem.string());
  if (!task) return result::forward(task);
  const model::Vocabulary vocabulary = pddl::vocabulary(*task);
  auto binding = translate::load_binding(options.binding, &vocabulary);
  if (!binding) return result::forward(binding);
  auto programs = HandWritten::load(options.programs);
  if (!programs) return result::forward(programs);
  return PlanningDesk(options, std::move(*task), std::move(*binding), std::move(*programs));
}

result::Result<PrepareOutcome> PlanningDesk::prepare(const StartState& start) const {
  auto task = task_.with_initial(pddl::from_named(start.planning));
  if (!task) return result::forward(task);
  pddl::Options search;
  search.optimal = options_.optimal;
  search.budget.time = options_.time;
  const model::Outcome solved = pddl::solve(*task, search);
  PrepareOutcome outcome;
  outcome.reason = solved.reason;
  if (!solved.plan) {
    outcome.status =
        solved.kind == model::OutcomeKind::Infeasible ? PrepareStatus::Infeasible : PrepareStatus::Exhausted;
    return outcome;
  }
  PreparedPlan& prepared = outcome.prepared;
  prepared.start = start;
  prepared.plan = *solved.plan;
  if (auto built = build(prepared, *task); !built) return tl::unexpected(std::move(built.error()));
  prepared.episode.cost = solved.plan->cost;
  if (std::isfinite(solved.plan->bound)) prepared.episode.bound = solved.plan->bound;
  prepared.episode.proved_optimal = solved.plan->proved_optimal;
  prepared.episode.first_plan_ms = solved.first_plan_ms;
  prepared.episode.optimal_plan_ms = solved.wall_ms;
  return outcome;
}

result::Result<PreparedPlan> PlanningDesk::rebuild(const StartState& start, const model::Plan& plan) const {
  auto task = task_.with_initial(pddl::from_named(start.planning));
  if (!task) return result::forward(task);
  PreparedPlan prepared;
  prepared.start = start;
  prepared.plan = plan;
  if (auto built = build(prepared, *task); !built) return tl::unexpected(std::move(built.error()));
  return prepared;
}

result::Result<void> PlanningDesk::build(PreparedPlan& prepared, const pddl::Task& task) const {
  if (!prepared.plan.orderings) {
    auto orderings = pddl::lift_partial_order(task, prepared.plan);
    if (!orderings) return tl::unexpected(std::move(orderings.error()));
    prepared.plan.orderings = std::move(*orderings);
  }
  auto run = pddl::describe_run(task, prepared.plan);
  if (!run) return tl::unexpected(std::move(run.error()));
  prepared.run = std::move(*run);
  auto translation = translate::translate(prepared.run, binding_,
                                          {.sequential = options_.sequential,
                                           .interval_us = options_.interval_us,
                                           .tare = prepared.start.tare,
                                           .measured = prepared.start.measured});
  if (!translation) return tl::unexpected(std::move(translation.error()));
  prepared.translation = std::move(*translation);
  for (const model::PlannedAction& planned : prepared.run.actions) {
    ActionRecord record;
    record.text = model::to_string(planned.action);
    record.planned_cost = cost_of(planned.action, planned.before);
    for (const translate::Sensor& sensor : binding_.sensors) {
      const auto value = planned.after.fluents.find(sensor.fluent);
      if (value != planned.after.fluents.end()) record.expected[sensor.fluent] = value->second;
    }
    prepared.episode.actions.push_back(std::move(record));
  }
  for (const translate::StepInfo& step : prepared.translation.steps) {
    if (step.kind == translate::StepKind::Action) prepared.episode.actions[*step.action].step = step.name;
  }
  if (auto scheduled = fill_schedule(prepared, binding_, options_.sequential); !scheduled) return scheduled;
  return compile_project(prepared.translation.project, programs_, prepared);
}

result::Result<PreparedPlan> PlanningDesk::observer(bool locate, std::chrono::milliseconds settle) const {
  PreparedPlan prepared;
  translate::ObserveOptions options;
  options.window = settle;
  options.locate = locate;
  options.interval_us = options_.interval_us;
  prepared.translation = translate::observe_program(binding_, options);
  if (auto compiled = compile_project(prepared.translation.project, programs_, prepared); !compiled) {
    return tl::unexpected(std::move(compiled.error()));
  }
  return prepared;
}

double PlanningDesk::cost_of(const model::GroundAction& action, const model::NamedState& before) const {
  return action_cost(task_, options_.report_fluent, action, before);
}

std::vector<GoalRecord> PlanningDesk::goal_status(const model::NamedState& state) const {
  std::vector<GoalRecord> records;
  if (auto status = pddl::evaluate_goal(task_, pddl::from_named(state))) {
    for (pddl::GoalStatus& goal : *status) records.push_back({std::move(goal.text), goal.met});
  }
  return records;
}

}  // namespace stepwright::executive

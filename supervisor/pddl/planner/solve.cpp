#include "supervisor/pddl/planner/solve.h"

#include <memory>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/grounding/never_valued.h"
#include "supervisor/pddl/plan/partial_order.h"
#include "supervisor/pddl/plan/simulate.h"
#include "supervisor/pddl/search/control/plan_runner.h"
#include "supervisor/pddl/search/improvement/action_elimination.h"
#include "supervisor/pddl/search/portfolio/first_plan.h"
#include "supervisor/pddl/search/portfolio/portfolio.h"

namespace stepwright::pddl {
namespace {

constexpr std::size_t kDefaultMemoryMb = 4096;
// Checks of the work on a plan's orderings that nothing ends: some milliseconds, which is enough for most
// plans also where the budget has ended.
constexpr std::size_t kFreeChecks = 16;

class Solver {
 public:
  Solver(const Task& task, const Options& options)
      : task_(task),
        options_(options),
        control_(options.budget.time,
                 options.budget.memory_mb == 0 ? kDefaultMemoryMb : options.budget.memory_mb, options.cancel,
                 options.budget.states) {}

  model::Outcome run() {
    ground_ = ground_task(
        task_.definition(), [this] { return stopped(); },
        [this](std::size_t bytes) { return makes_room_for(bytes); });
    if (ground_.cancelled) return finish();
    if (ground_.unreachable_goal) return infeasible(*ground_.unreachable_goal);
    leave_out();
    arrange_by_groups(ground_);
    report();
    if (!makes_room_for(indices_of_task())) return finish();
    const StateSpace space(ground_);
    if (stopped()) return finish();
    const RelaxedTask relaxed(space);
    if (stopped()) return finish();
    const SearchStatus status = FirstPlan(relaxed, control_, options_.threads).run(reason_);
    if (status == SearchStatus::Exhausted) {
      return infeasible("all states that can be reached were searched (" +
                        std::to_string(control_.expanded()) + "), none of them meets the goal");
    }
    if (status == SearchStatus::Stopped) return finish();
    if (options_.first_only) return finish(model::OutcomeKind::Solved);
    if (!options_.optimal) shorten(space);
    Portfolio portfolio(relaxed, control_, {.prove_first = options_.optimal, .threads = options_.threads});
    proved_ = portfolio.run(reason_);
    if (portfolio.unbounded())
      outcome_.reason = "the metric can be improved without end: there is no optimum";
    return finish(proved_ ? model::OutcomeKind::Solved : model::OutcomeKind::Exhausted);
  }

 private:
  // Bounds and groups stay true of what is left.
  void leave_out() {
    if (!options_.excluded) return;
    std::erase_if(ground_.operators,
                  [this](const GroundOperator& op) { return options_.excluded(action_of(ground_, op)); });
  }

  bool stopped() {
    if (reason_ == StopReason::None) reason_ = control_.check();
    return reason_ != StopReason::None;
  }

  // Ends the search if it does not.
  bool makes_room_for(std::size_t bytes) {
    if (control_.has_room_for(bytes)) return true;
    control_.run_out_of_memory();
    return !stopped();
  }

  // What the states' and the relaxed task's indices take, seen from above: nothing stops their making.
  std::size_t indices_of_task() const {
    std::size_t numbers = 0;
    for (const GroundOperator& op : ground_.operators) {
      numbers += 8 + op.precondition.literals.size() + 2 * op.precondition.comparisons.size();
      for (const GroundEffect& effect : op.effects) {
        numbers += 4 + 4 * (effect.adds.size() + effect.deletes.size()) + 8 * effect.numeric.size() +
                   effect.when.literals.size();
      }
    }
    return numbers * 3 * sizeof(int);
  }

  // What the plan can do without is seen at once; bounds and the proof take longer.
  void shorten(const StateSpace& space) {
    offer_plan(space, control_, eliminate_actions(space, control_.best().operators, control_));
  }

  // The searches minimize the metric without its base; this is its value.
  double metric_value(double internal) const {
    const double value = internal + ground_.base_cost;
    return ground_.maximize ? -value : value + 0.0;
  }

  model::Plan plan(const Incumbent& best) const {
    model::Plan plan;
    for (const int op : best.operators) {
      plan.actions.push_back(action_of(ground_, ground_.operators[static_cast<std::size_t>(op)]));
    }
    plan.cost = snap(metric_value(best.quality.cost));
    plan.bound = proved_ ? plan.cost : metric_value(control_.bound());
    plan.proved_optimal = proved_;
    return plan;
  }

  void report() {
    control_.on_improvement = [this](const Incumbent& best) {
      if (outcome_.first_plan_ms == 0.0) outcome_.first_plan_ms = control_.elapsed_ms();
      if (options_.on_improvement) options_.on_improvement(plan(best));
    };
    control_.on_second = [this](const Incumbent& incumbent, double bound) {
      if (!options_.on_progress) return;
      const bool found = incumbent.quality.found();
      const model::Plan best = found ? plan(incumbent) : model::Plan{};
      options_.on_progress({control_.elapsed_ms(), control_.expanded(), control_.peak_mb(),
                            found ? &best : nullptr, metric_value(bound)});
    };
  }

  void figures() {
    outcome_.wall_ms = control_.elapsed_ms();
    outcome_.expanded = control_.expanded();
    outcome_.peak_mb = control_.peak_mb();
  }

  model::Outcome infeasible(std::string reason) {
    figures();
    outcome_.kind = model::OutcomeKind::Infeasible;
    const std::string hint = never_valued(ground_);
    outcome_.reason = std::move(reason) + (hint.empty() ? "" : "\n  hint: " + hint);
    return std::move(outcome_);
  }

  model::Outcome finish(model::OutcomeKind kind = model::OutcomeKind::Exhausted) {
    if (reason_ == StopReason::Cancelled) {
      kind = model::OutcomeKind::Cancelled;
      if (outcome_.reason.empty()) outcome_.reason = "the search was interrupted";
    }
    outcome_.kind = kind;
    if (outcome_.reason.empty() && reason_ == StopReason::Time) outcome_.reason = "the time budget ended";
    if (outcome_.reason.empty() && reason_ == StopReason::Memory) outcome_.reason = "the memory budget ended";
    if (outcome_.reason.empty() && reason_ == StopReason::States)
      outcome_.reason = "the budget of states ended";
    if (const Incumbent best = control_.best(); best.quality.found()) accept(plan(best));
    figures();
    return std::move(outcome_);
  }

  void refuse(const std::string& why) {
    outcome_.kind = model::OutcomeKind::Exhausted;
    outcome_.reason = "the plan found does not pass validation: " + why;
  }

  // Nothing leaves the planner that the schemas do not confirm.
  void accept(model::Plan plan) {
    auto end = state_after(task_, plan);
    if (!end) return refuse(result::to_string(end.error()));
    const auto goals = evaluate_goal(task_, *end);
    if (!goals) return refuse(result::to_string(goals.error()));
    for (const GoalStatus& goal : *goals) {
      if (!goal.met) return refuse("the goal " + goal.text + " does not hold after it");
    }
    std::size_t asked = 0;
    auto orderings =
        lift_partial_order(task_, plan, [&] { return ++asked > kFreeChecks && control_.used_up(); });
    if (orderings) plan.orderings = std::move(*orderings);
    outcome_.plan = std::move(plan);
  }

  const Task& task_;
  const Options& options_;
  SearchControl control_;
  GroundTask ground_;
  StopReason reason_ = StopReason::None;
  bool proved_ = false;
  model::Outcome outcome_;
};

}  // namespace

model::Outcome solve(const Task& task, const Options& options) {
  return Solver(task, options).run();
}

}  // namespace stepwright::pddl

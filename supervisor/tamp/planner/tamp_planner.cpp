#include "supervisor/tamp/planner/tamp_planner.h"

#include <time.h>

#include <utility>

#include "supervisor/htn/search/search.h"
#include "supervisor/tamp/intervals/cause/cause.h"
#include "supervisor/tamp/literal/geometric_backtracking.h"
#include "supervisor/tamp/planner/interval_guard.h"
#include "supervisor/tamp/planner/sequence_solver.h"
#include "supervisor/tamp/predicates/certify.h"

namespace stepwright::tamp::planner {

namespace {

using Clock = std::chrono::steady_clock;

double ms_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

// Of this thread.
double cpu_ms() {
  timespec now{};
  if (::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return 0.0;
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

class Planning {
 public:
  Planning(const scene::RobotCell& cell, const htn::PlanningTask& task, const TampOptions& options)
      : task_(task),
        options_(options),
        grounding_(task, cell),
        workspace_(cell, options.seed),
        began_(Clock::now()),
        cpu_began_(cpu_ms()) {
    search_options_.until = options.until;
    search_options_.cancel = options.cancel;
  }

  TampOutcome literally() {
    literal::GeometricBacktracking geometry(
        grounding_, workspace_,
        {options_.until, options_.cancel, options_.most_failed, options_.method != Method::PaperFirstWay});
    htn::Search search(task_, search_options_, &geometry);
    htn::SearchOutcome found = search.next();
    take(search, found);
    outcome_.figures.configurations_again = geometry.configurations_in_backtracking();
    outcome_.figures.failed_again = geometry.failed_in_backtracking();
    if (found.plan) finish(geometry.settled(), *std::move(found.plan));
    return std::move(outcome_);
  }

  TampOutcome by_sequences(const IntervalModel& model) {
    IntervalGuard guard(grounding_, model);
    htn::Search search(task_, search_options_, &guard);
    std::string obstacle;
    for (;;) {
      htn::SearchOutcome found = search.next();
      take(search, found);
      if (!found.plan) break;
      std::vector<std::size_t> steps;
      SequenceSolver solver(workspace_, grounding_.actions_of(*found.plan, steps),
                            {options_.until, options_.cancel, options_.most_failed, true});
      ++outcome_.figures.sequences;
      SolverAnswer answer = solver.solve();
      outcome_.figures.backjumps += solver.backjumps();
      outcome_.figures.jumped_over += solver.jumped_over();
      if (answer.solved) {
        finish(std::move(answer.settled), *std::move(found.plan));
        break;
      }
      ++(answer.proven ? outcome_.figures.proved_nogoods : outcome_.figures.budget_nogoods);
      obstacle = answer.reason;
      if (steps.empty() || workspace_.counts().failed >= options_.most_failed) {
        outcome_.kind = model::OutcomeKind::Exhausted;
        outcome_.reason = obstacle;
        break;
      }
      search.reject(steps[std::min(answer.keep, steps.size() - 1)], answer.proven);
    }
    outcome_.figures.refuted = guard.refuted();
    if (!outcome_.plan) explain_why(guard, model, obstacle);
    return std::move(outcome_);
  }

 private:
  void take(const htn::Search& search, const htn::SearchOutcome& found) {
    outcome_.kind = found.kind;
    outcome_.reason = found.reason;
    outcome_.figures.decompositions = search.statistics().decompositions;
    outcome_.figures.refusals = search.statistics().refusals;
    take_counts();
    outcome_.figures.plan_ms = ms_between(began_, Clock::now());
    outcome_.figures.plan_cpu_ms = cpu_ms() - cpu_began_;
  }

  void take_counts() {
    const predicates::Counts& counts = workspace_.counts();
    outcome_.figures.configurations = counts.configurations;
    outcome_.figures.failed = counts.failed;
    outcome_.figures.paths = counts.paths;
    outcome_.figures.failed_paths = counts.failed_paths;
  }

  // A refuted sequence has a cause in words; a region that is full, too.
  void explain_why(const IntervalGuard& guard, const IntervalModel& model, const std::string& obstacle) {
    if (!obstacle.empty()) outcome_.reason = obstacle;
    if (!obstacle.empty() || guard.first_refuted().empty()) return;
    if (const auto cause = explain(model.cell(), guard.first_refuted())) outcome_.reason = cause->sentence;
  }

  void finish(std::vector<predicates::Settled> settled, htn::Plan tasks) {
    const Clock::time_point planned = Clock::now();
    take_counts();
    outcome_.figures.plan_ms = ms_between(began_, planned);
    outcome_.figures.plan_cpu_ms = cpu_ms() - cpu_began_;
    const auto uncertain = predicates::certify(workspace_, settled, options_.seed);
    outcome_.figures.certify_ms = ms_between(planned, Clock::now());
    if (uncertain) {
      outcome_.kind = model::OutcomeKind::Exhausted;
      outcome_.reason = scene::text_of(workspace_.cell(), settled[uncertain->action].action.what) + ", " +
                        name_of(uncertain->phase) + ": " + uncertain->what;
      return;
    }
    scene::TampPlan plan;
    for (predicates::Settled& each : settled) plan.actions.push_back(std::move(each.action));
    outcome_.plan = std::move(plan);
    outcome_.tasks = std::move(tasks);
    outcome_.kind = model::OutcomeKind::Solved;
  }

  const htn::PlanningTask& task_;
  const TampOptions& options_;
  predicates::Grounding grounding_;
  predicates::Workspace workspace_;
  htn::SearchOptions search_options_;
  Clock::time_point began_;
  double cpu_began_;
  TampOutcome outcome_;
};

}  // namespace

TampOutcome plan(const scene::RobotCell& cell, const htn::PlanningTask& task, const IntervalModel* model,
                 const TampOptions& options) {
  Planning planning(cell, task, options);
  return options.method != Method::Ours || model == nullptr ? planning.literally()
                                                            : planning.by_sequences(*model);
}

}  // namespace stepwright::tamp::planner

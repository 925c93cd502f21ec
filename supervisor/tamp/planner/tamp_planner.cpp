#include "supervisor/tamp/planner/tamp_planner.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "supervisor/htn/search/search.h"
#include "supervisor/tamp/literal/geometric_backtracking.h"
#include "supervisor/tamp/planner/cause_of_refusal.h"
#include "supervisor/tamp/planner/interval_guard.h"
#include "supervisor/tamp/planner/outcome_builder.h"

namespace stepwright::tamp::planner {

namespace {

class Planning {
 public:
  Planning(const scene::RobotCell& cell, const htn::PlanningTask& task, const IntervalModel* model,
           const TampOptions& options)
      : cell_(cell), task_(task), options_(options), grounding_(task, cell), builder_(cell, options, model) {
    search_options_.until = options.until;
    search_options_.cancel = options.cancel;
  }

  TampOutcome literally() {
    literal::GeometricBacktracking geometry(
        grounding_, builder_.workspace(),
        {options_.until, options_.cancel, options_.most_failed, options_.method != Method::PaperFirstWay,
         options_.method == Method::PaperFromOne ? std::size_t{1} : std::size_t{0}});
    htn::Search search(task_, search_options_, &geometry);
    htn::SearchOutcome found = search.next();
    take(search, found);
    outcome().figures.configurations_again = geometry.configurations_in_backtracking();
    outcome().figures.failed_again = geometry.failed_in_backtracking();
    if (found.plan && builder_.finish(geometry.settled())) outcome().tasks = std::move(found.plan);
    builder_.close();
    return std::move(outcome());
  }

  TampOutcome by_sequences(const IntervalModel& model) {
    IntervalGuard guard(grounding_, model);
    htn::Search search(task_, search_options_, &guard);
    for (std::size_t round = 0;; ++round) {
      builder_.begin_round(round);
      if (try_again() || try_new(search)) break;
      const bool all_proved = outcome().kind == model::OutcomeKind::Infeasible && given_up_.empty();
      if (all_proved || outcome().kind == model::OutcomeKind::Cancelled) break;
      outcome().kind = model::OutcomeKind::Exhausted;
      if (!builder_.worth_another(round)) break;
      search.retry_unproven();
    }
    outcome().figures.refuted = guard.refuted();
    if (!outcome().plan) explain_why(guard, model);
    builder_.close();
    return std::move(outcome());
  }

 private:
  // A plan of tasks whose geometry was not found, which proves nothing.
  struct Sequence {
    htn::Plan tasks;
    std::vector<scene::ActionSpec> actions;
  };

  TampOutcome& outcome() { return builder_.outcome(); }

  void take(const htn::Search& search, const htn::SearchOutcome& found) {
    outcome().kind = found.kind;
    outcome().reason = found.reason;
    outcome().figures.decompositions = search.statistics().decompositions;
    outcome().figures.refusals = search.statistics().refusals;
    builder_.take_figures();
  }

  // True: that is the end, with a plan or without.
  bool ends(SolverAnswer answer, Sequence& sequence) {
    if (answer.solved) {
      obstacle_.clear();
      if (builder_.finish(std::move(answer.settled))) outcome().tasks = std::move(sequence.tasks);
      return true;
    }
    obstacle_ = answer.reason;
    return false;
  }

  // Sequences that were given up before. The search does not find them again.
  bool try_again() {
    for (Sequence& each : std::exchange(given_up_, {})) {
      SolverAnswer answer = builder_.attempt(each.actions);
      const bool proven = answer.proven;
      if (ends(std::move(answer), each)) return true;
      if (!proven) given_up_.push_back(std::move(each));
    }
    return false;
  }

  bool try_new(htn::Search& search) {
    for (;;) {
      htn::SearchOutcome found = search.next();
      take(search, found);
      if (!found.plan) return false;
      std::vector<std::size_t> steps;
      Sequence sequence{*std::move(found.plan), {}};
      sequence.actions = grounding_.actions_of(sequence.tasks, steps);
      SolverAnswer answer = builder_.attempt(sequence.actions);
      const bool proven = answer.proven;
      const std::size_t keep = answer.keep;
      if (ends(std::move(answer), sequence)) return true;
      if (!proven) given_up_.push_back(std::move(sequence));
      outcome().kind = model::OutcomeKind::Exhausted;
      if (steps.empty() || builder_.used_up()) return false;
      search.reject(steps[std::min(keep, steps.size() - 1)], proven);
    }
  }

  // A refuted sequence has a cause in words; a region that is full, too.
  void explain_why(const IntervalGuard& guard, const IntervalModel& model) {
    if (!obstacle_.empty()) outcome().reason = obstacle_;
    if (!obstacle_.empty() || guard.first_refuted().empty()) return;
    const auto solvable = [this](const scene::RobotCell& cell, const IntervalModel& of_cell,
                                 const TampOptions& options) {
      return plan(cell, task_, &of_cell, options).kind == model::OutcomeKind::Solved;
    };
    if (auto cause = cause_of_refusal(cell_, model, guard.first_refuted(), options_, solvable))
      outcome().reason = *std::move(cause);
  }

  const scene::RobotCell& cell_;
  const htn::PlanningTask& task_;
  const TampOptions& options_;
  predicates::Grounding grounding_;
  OutcomeBuilder builder_;
  htn::SearchOptions search_options_;
  std::vector<Sequence> given_up_;
  std::string obstacle_;
};

}  // namespace

TampOutcome plan(const scene::RobotCell& cell, const htn::PlanningTask& task, const IntervalModel* model,
                 const TampOptions& options) {
  Planning planning(cell, task, model, options);
  return options.method != Method::Ours || model == nullptr ? planning.literally()
                                                            : planning.by_sequences(*model);
}

}  // namespace stepwright::tamp::planner

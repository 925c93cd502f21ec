#include "supervisor/pddl/repair.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "supervisor/pddl/partial_order.h"
#include "supervisor/pddl/regression.h"
#include "supervisor/pddl/simulate.h"

namespace stepwright::pddl {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Candidate {
  model::Plan plan;
  std::size_t kept = 0;
};

class Repair {
 public:
  Repair(const Task& task, const std::vector<model::GroundAction>& remaining, const RepairOptions& options)
      : task_(task), remaining_(remaining), options_(options) {
    result_.of = remaining.size();
  }

  RepairOutcome run() {
    const auto start = Clock::now();
    if (auto plan = executed({}, 0); plan && !remaining_.empty()) {
      result_.repair_ms = ms_since(start);
      take(RepairKind::Kept, {std::move(*plan), remaining_.size()});
      return std::move(result_);
    }
    goals_ = weakest_preconditions(task_, remaining_);
    auto candidate = next_candidate();
    if (!candidate || options_.compare) replan();
    const bool ended = result_.outcome.kind == model::OutcomeKind::Cancelled;
    const std::optional<model::Plan> fresh = result_.outcome.plan;
    std::optional<Candidate> best = candidate;
    // The longest suffix that costs no more than the new plan; without a new plan the longest there is.
    while (candidate && fresh && order(candidate->plan, *fresh) > 0) {
      candidate = next_candidate();
      if (candidate && order(candidate->plan, best->plan) < 0) best = candidate;
    }
    if (best) result_.repaired_cost = best->plan.cost;
    if (fresh) result_.kind = RepairKind::Replanned;
    if (candidate && !ended) take(RepairKind::Repaired, std::move(*candidate));
    return std::move(result_);
  }

 private:
  bool cancelled() const { return options_.search.cancel != nullptr && *options_.search.cancel; }

  // -1, 0 or 1: by cost in the sense of the metric, then by length.
  int order(const model::Plan& a, const model::Plan& b) const {
    if (a.cost != b.cost) return (a.cost < b.cost) != task_.maximizes() ? -1 : 1;
    if (a.actions.size() != b.actions.size()) return a.actions.size() < b.actions.size() ? -1 : 1;
    return 0;
  }

  // The connection and the actions from `first` on, if they lead to the goal.
  std::optional<model::Plan> executed(const std::vector<model::GroundAction>& connection,
                                      std::size_t first) const {
    model::Plan plan;
    plan.actions = connection;
    plan.actions.insert(plan.actions.end(), remaining_.begin() + static_cast<std::ptrdiff_t>(first),
                        remaining_.end());
    const auto trace = simulate(task_, plan);
    if (!trace) return std::nullopt;
    const auto goals = evaluate_goal(task_, trace->states.back());
    const auto met = [](const GoalStatus& goal) { return goal.met; };
    if (!goals || !std::all_of(goals->begin(), goals->end(), met)) return std::nullopt;
    plan.cost = trace->cost.back();
    plan.bound = task_.maximizes() ? std::numeric_limits<double>::infinity()
                                   : -std::numeric_limits<double>::infinity();
    return plan;
  }

  // The next suffix, from the longest to the shortest, that a connection reaches while time is left.
  std::optional<Candidate> next_candidate() {
    const auto start = Clock::now();
    const std::chrono::duration<double, std::milli> used(result_.repair_ms);
    auto found =
        find_candidate(start + std::chrono::duration_cast<Clock::duration>(options_.connect_time - used));
    result_.repair_ms += ms_since(start);
    return found;
  }

  std::optional<Candidate> find_candidate(Clock::time_point deadline) {
    if (!goals_) return std::nullopt;
    while (next_ < remaining_.size() && !cancelled()) {
      const std::size_t first = next_++;
      if (auto plan = executed({}, first)) {  // what was in front of it is not needed any more
        next_ = remaining_.size();            // a shorter suffix keeps less and needs no less
        return Candidate{std::move(*plan), remaining_.size() - first};
      }
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
      if (left.count() <= 0) return std::nullopt;
      if (!(*goals_)[first]) continue;
      if (auto plan = connected(*(*goals_)[first], first, left)) {
        return Candidate{std::move(*plan), remaining_.size() - first};
      }
    }
    return std::nullopt;
  }

  std::optional<model::Plan> connected(const std::string& goal, std::size_t first,
                                       std::chrono::milliseconds time) const {
    const auto to_start = task_.with_goal(goal);
    if (!to_start) return std::nullopt;
    Options search;
    search.optimal = options_.search.optimal;
    search.budget = {std::max(std::chrono::milliseconds(1), time / 2), options_.search.budget.memory_mb};
    search.cancel = options_.search.cancel;
    const model::Outcome outcome = solve(*to_start, search);
    if (!outcome.plan || outcome.plan->actions.size() > options_.longest_connection) return std::nullopt;
    return executed(outcome.plan->actions, first);
  }

  void replan() {
    if (cancelled()) {
      result_.outcome.kind = model::OutcomeKind::Cancelled;
      return;
    }
    const auto start = Clock::now();
    result_.outcome = solve(task_, options_.search);
    result_.replan_ms = ms_since(start);
    if (result_.outcome.plan) result_.replanned_cost = result_.outcome.plan->cost;
  }

  void take(RepairKind kind, Candidate candidate) {
    model::Plan& plan = candidate.plan;
    if (const auto& fresh = result_.outcome.plan) {
      plan.bound = fresh->bound;
      plan.proved_optimal = fresh->proved_optimal && order(plan, *fresh) == 0;
    }
    if (auto orderings = lift_partial_order(task_, plan)) plan.orderings = std::move(*orderings);
    result_.kind = kind;
    result_.kept = candidate.kept;
    result_.connection = plan.actions.size() - candidate.kept;
    const bool told = result_.outcome.plan.has_value();
    if (!told) {
      result_.outcome.kind = model::OutcomeKind::Solved;
      result_.outcome.reason.clear();
      result_.outcome.first_plan_ms = result_.outcome.wall_ms = result_.repair_ms;
    }
    result_.outcome.plan = std::move(plan);
  }

  const Task& task_;
  const std::vector<model::GroundAction>& remaining_;
  const RepairOptions& options_;
  result::Result<std::vector<std::optional<std::string>>> goals_;  // of each suffix
  std::size_t next_ = 0;                                           // suffix to look at
  RepairOutcome result_;
};

}  // namespace

const char* to_string(RepairKind kind) {
  static constexpr std::array kNames = {"kept", "repaired", "replanned", "none"};
  return kNames[static_cast<std::size_t>(kind)];
}

RepairOutcome repair(const Task& task, const std::vector<model::GroundAction>& remaining,
                     const RepairOptions& options) {
  return Repair(task, remaining, options).run();
}

}  // namespace stepwright::pddl

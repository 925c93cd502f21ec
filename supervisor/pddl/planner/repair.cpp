#include "supervisor/pddl/planner/repair.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <utility>

#include "supervisor/pddl/plan/partial_order.h"
#include "supervisor/pddl/plan/regression.h"
#include "supervisor/pddl/plan/simulate.h"

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
    if (!options.search.excluded) return;
    for (std::size_t i = 0; i < remaining.size(); ++i) {
      if (options.search.excluded(remaining[i])) first_ = next_ = i + 1;
    }
  }

  RepairOutcome run() {
    const auto start = Clock::now();
    if (auto plan = first_ == 0 ? executed({}, 0) : std::nullopt; plan && !remaining_.empty()) {
      result_.repair_ms = ms_since(start);
      take(RepairKind::Kept, {std::move(*plan), remaining_.size()});
      return std::move(result_);
    }
    if (options_.compare) {
      beside_a_new_plan();
    } else {
      connect();
    }
    return std::move(result_);
  }

 private:
  // What a repair may cost is known once there is a new plan, and what it may consist of, too: the actions of
  // the new plan that are not in the suffix lead up to it, or nothing as short does.
  void beside_a_new_plan() {
    replan();
    if (result_.outcome.kind == model::OutcomeKind::Cancelled ||
        result_.outcome.kind == model::OutcomeKind::Infeasible) {
      return;
    }
    const std::optional<model::Plan> fresh = result_.outcome.plan;
    const auto start = Clock::now();
    std::optional<Candidate> candidate = fresh ? rearranged(*fresh) : std::nullopt;
    result_.repair_ms += ms_since(start);
    if (!candidate && !(fresh && fresh->proved_optimal)) return connect();
    if (fresh) result_.kind = RepairKind::Replanned;
    if (!candidate) return;
    result_.repaired_cost = candidate->plan.cost;
    take(RepairKind::Repaired, std::move(*candidate));
  }

  // The longest suffix, behind what the new plan has beside it in its order, if that is as good as the new
  // plan.
  std::optional<Candidate> rearranged(const model::Plan& fresh) const {
    std::vector<model::GroundAction> gap = fresh.actions;
    std::vector<std::vector<model::GroundAction>> gaps;  // in front of the suffixes, from the shortest on
    for (std::size_t i = remaining_.size(); i-- > first_;) {
      // From the end, so that of two equal actions the one that comes first stays in front.
      const auto same = std::find(gap.rbegin(), gap.rend(), remaining_[i]);
      if (same == gap.rend()) break;
      gap.erase(std::next(same).base());
      gaps.push_back(gap);
    }
    const std::size_t longest = std::min(remaining_.size() - first_, fresh.actions.size());
    for (std::size_t kept = longest; kept > 0; --kept) {
      const bool whole = kept == fresh.actions.size();  // nothing fits in front
      if (kept > gaps.size() && !whole) continue;
      auto plan =
          executed(whole ? std::vector<model::GroundAction>{} : gaps[kept - 1], remaining_.size() - kept);
      if (plan && order(*plan, fresh) <= 0) return Candidate{std::move(*plan), kept};
    }
    return std::nullopt;
  }

  // The longest suffix that a search from here reaches, and that costs no more than the new plan if there is
  // one.
  void connect() {
    const auto start = Clock::now();
    goals_ = weakest_preconditions(task_, remaining_);
    result_.repair_ms += ms_since(start);
    auto candidate = next_candidate();
    if (!candidate && !options_.compare) replan();
    const bool ended = result_.outcome.kind == model::OutcomeKind::Cancelled;
    const std::optional<model::Plan> fresh = result_.outcome.plan;
    std::optional<Candidate> best = candidate;
    while (candidate && fresh && order(candidate->plan, *fresh) > 0) {
      candidate = next_candidate();
      if (candidate && order(candidate->plan, best->plan) < 0) best = candidate;
    }
    if (best) result_.repaired_cost = best->plan.cost;
    if (fresh) result_.kind = RepairKind::Replanned;
    if (candidate && !ended) take(RepairKind::Repaired, std::move(*candidate));
  }

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
    auto found = find_candidate(start + std::chrono::duration_cast<Clock::duration>(longest() - used));
    result_.repair_ms += ms_since(start);
    return found;
  }

  // Of all the connections together. Where there is a new plan, longer than that took would be in vain.
  std::chrono::duration<double, std::milli> longest() const {
    const std::chrono::duration<double, std::milli> most = options_.connect_time;
    const std::chrono::duration<double, std::milli> fresh(result_.replan_ms);
    return result_.outcome.plan ? std::min(most, fresh) : most;
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
                                       std::chrono::milliseconds time) {
    const auto to_start = task_.with_goal(goal);
    if (!to_start) return std::nullopt;
    ++result_.searches;
    Options search;
    search.optimal = options_.search.optimal;
    search.budget = {std::max(std::chrono::milliseconds(1), time / 2), options_.search.budget.memory_mb};
    search.cancel = options_.search.cancel;
    search.excluded = options_.search.excluded;
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
  std::size_t first_ = 0;  // of the actions that may be kept: all before it, or one of them, is excluded
  std::size_t next_ = 0;   // suffix to look at
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

#include "supervisor/tamp/planner/skeleton_planner.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "supervisor/pddl/planner/solve.h"
#include "supervisor/tamp/intervals/cause/conflict_set.h"
#include "supervisor/tamp/intervals/network/network.h"
#include "supervisor/tamp/planner/cause_of_refusal.h"
#include "supervisor/tamp/planner/outcome_builder.h"
#include "supervisor/tamp/predicates/grounding.h"

namespace stepwright::tamp::planner {

namespace {

// Of each geometric action of a skeleton: which action of its plan, and what it does.
struct Geometric {
  std::vector<model::GroundAction> actions;
  std::vector<scene::ActionSpec> specs;
};

// All that the conflict is made of is about one thing, and none of it ties it to another one.
std::optional<std::size_t> only_object_of(const ConflictSet& set) {
  if (set.constraints.empty()) return std::nullopt;
  const std::size_t object = set.constraints.front().object;
  for (const Constraint& each : set.constraints)
    if (each.object != object || each.kind == ConstraintKind::Stack || each.kind == ConstraintKind::Beyond)
      return std::nullopt;
  return object;
}

// The only action that the conflict is made of, if it has nothing to do with where things stand at first: it
// can never be done.
std::optional<std::size_t> only_action_of(const ConflictSet& set) {
  if (set.constraints.empty()) return std::nullopt;
  const std::size_t action = set.constraints.front().action;
  for (const Constraint& each : set.constraints)
    if (each.action != action || each.kind == ConstraintKind::StartPosition ||
        each.kind == ConstraintKind::StartHeight || each.kind == ConstraintKind::StartAngle ||
        each.kind == ConstraintKind::Stack || each.kind == ConstraintKind::Beyond)
      return std::nullopt;
  return action;
}

class SkeletonPlanning {
 public:
  SkeletonPlanning(const scene::RobotCell& cell, const pddl::OutsideTask& task, const IntervalModel& model,
                   const TampOptions& options)
      : cell_(cell), task_(task), model_(model), options_(options), builder_(cell, options, &model) {
    for (const auto& [name, effects] : task.effects) counted_[name] = thing_of(effects.front());
  }

  TampOutcome run() {
    for (std::size_t round = 0;; ++round) {
      builder_.begin_round(round);
      soft_.clear();
      if (try_skeletons()) break;
      const bool all_proved = outcome().kind == model::OutcomeKind::Infeasible && soft_.empty();
      if (all_proved || outcome().kind == model::OutcomeKind::Cancelled) break;
      outcome().kind = model::OutcomeKind::Exhausted;
      if (skeletons_used_up() || !builder_.worth_another(round)) break;
    }
    if (!outcome().plan) explain_why();
    builder_.close();
    return std::move(outcome());
  }

 private:
  TampOutcome& outcome() { return builder_.outcome(); }

  // A refuted sequence has a cause in words.
  void explain_why() {
    if (!obstacle_.empty()) outcome().reason = obstacle_;
    if (!obstacle_.empty() || first_refuted_.empty()) return;
    const auto solvable = [this](const scene::RobotCell& cell, const IntervalModel& of_cell,
                                 const TampOptions& options) {
      return plan(cell, task_, of_cell, options).kind == model::OutcomeKind::Solved;
    };
    if (auto cause = cause_of_refusal(cell_, model_, first_refuted_, options_, solvable))
      outcome().reason = *std::move(cause);
  }

  // The parameter that names what is picked or placed; a hand that moves away handles nothing.
  static int thing_of(const pddl::OutsideAtom& atom) {
    if (atom.predicate == "is-away" || atom.arguments.empty()) return -1;
    return atom.arguments.back().parameter;
  }

  std::optional<scene::ActionSpec> meant_by(const model::GroundAction& action) const {
    const auto effects = task_.effects.find(action.name);
    if (effects == task_.effects.end()) return std::nullopt;
    const pddl::OutsideAtom& atom = effects->second.front();
    return predicates::action_of(cell_, atom.predicate, atom.of(action));
  }

  // Names that the cell does not have cannot be done, nor what was refuted by itself.
  bool is_excluded(const model::GroundAction& action) const {
    return (task_.effects.contains(action.name) && !meant_by(action)) ||
           std::ranges::find(impossible_, action) != impossible_.end();
  }

  Geometric geometric_of(const model::Plan& plan) const {
    Geometric found;
    for (const model::GroundAction& each : plan.actions)
      if (const auto spec = meant_by(each)) {
        found.actions.push_back(each);
        found.specs.push_back(*spec);
      }
    return found;
  }

  bool skeletons_used_up() {
    return builder_.outcome().figures.decompositions >= options_.most_skeletons ||
           builder_.outcome().figures.states >= options_.most_states;
  }

  model::Outcome next_skeleton() {
    std::vector<pddl::Beginning> forbidden = proved_;
    forbidden.insert(forbidden.end(), soft_.begin(), soft_.end());
    pddl::Options options;
    options.first_only = true;
    options.cancel = options_.cancel;
    options.excluded = [this](const model::GroundAction& action) { return is_excluded(action); };
    if (options_.until) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
          *options_.until - std::chrono::steady_clock::now());
      options.budget.time = std::max(left, std::chrono::milliseconds(1));
    }
    options.budget.states = options_.most_states - outcome().figures.states;  // more than 0
    model::Outcome found = pddl::solve(without_beginnings(task_.task, counted_, forbidden), options);
    outcome().figures.states += found.expanded;
    return found;
  }

  // True: that is the end, with a plan or without.
  bool try_skeletons() {
    for (;;) {
      if (skeletons_used_up()) {
        outcome().kind = model::OutcomeKind::Exhausted;
        return false;
      }
      model::Outcome found = next_skeleton();
      outcome().kind = found.kind;
      outcome().reason = found.reason;
      builder_.take_figures();
      if (!found.plan) return false;
      ++outcome().figures.decompositions;
      const Geometric geometric = geometric_of(*found.plan);
      if (refuted(geometric)) continue;
      SolverAnswer answer = builder_.attempt(geometric.specs);
      if (answer.solved) {
        obstacle_.clear();
        if (builder_.finish(std::move(answer.settled))) outcome().skeleton = std::move(found.plan);
        return true;
      }
      obstacle_ = answer.reason;
      outcome().kind = model::OutcomeKind::Exhausted;
      forbid(answer.proven ? proved_ : soft_, geometric, answer.keep);
      if (builder_.used_up()) return false;
    }
  }

  // Plans that begin with the first keep + 1 geometric actions.
  static void forbid(std::vector<pddl::Beginning>& list, const Geometric& geometric, std::size_t keep) {
    const auto end = static_cast<std::ptrdiff_t>(std::min(keep + 1, geometric.actions.size()));
    list.push_back({{geometric.actions.begin(), geometric.actions.begin() + end}});
  }

  // By intervals; then what is refuted is forbidden.
  bool refuted(const Geometric& geometric) {
    Network network(model_.cell());
    std::vector<Action> sequence;
    for (std::size_t k = 0; k < geometric.specs.size(); ++k) {
      if (!validate(model_.cell(), with(sequence, model_.action_of(geometric.specs[k])))) {
        forbid(proved_, geometric, k);
        return true;
      }
      sequence.push_back(model_.action_of(geometric.specs[k]));
      if (network.push(sequence.back())) continue;
      ++outcome().figures.refuted;
      if (first_refuted_.empty()) first_refuted_ = sequence;
      learn(geometric, sequence);
      return true;
    }
    return false;
  }

  static std::vector<Action> with(std::vector<Action> sequence, const Action& next) {
    sequence.push_back(next);
    return sequence;
  }

  void learn(const Geometric& geometric, const std::vector<Action>& sequence) {
    constexpr std::size_t kMostNodes = 100;  // a conflict that is larger than it must be forbids less
    const auto set = conflict_of(model_.cell(), sequence, kMostNodes);
    if (const auto alone = set ? only_action_of(*set) : std::nullopt) {
      impossible_.push_back(geometric.actions[*alone]);
      return;
    }
    const auto object = set ? only_object_of(*set) : std::nullopt;
    if (!object) return forbid(proved_, geometric, sequence.size() - 1);
    std::size_t last = 0;
    for (const Constraint& each : set->constraints) last = std::max(last, each.action);
    pddl::Beginning beginning{{}, cell_.things[*object].name};
    for (std::size_t k = 0; k <= last; ++k) {
      const auto counts = counted_.find(geometric.actions[k].name);
      if (sequence[k].kind == tamp::ActionKind::MoveAway || sequence[k].object != *object) continue;
      // An action whose thing is no parameter cannot be told from others.
      if (counts->second < 0) return forbid(proved_, geometric, last);
      beginning.actions.push_back(geometric.actions[k]);
    }
    proved_.push_back(std::move(beginning));
  }

  const scene::RobotCell& cell_;
  const pddl::OutsideTask& task_;
  const IntervalModel& model_;
  const TampOptions& options_;
  OutcomeBuilder builder_;
  pddl::CountedActions counted_;
  std::vector<pddl::Beginning> proved_, soft_;
  std::vector<model::GroundAction> impossible_;
  std::vector<Action> first_refuted_;
  std::string obstacle_;
};

}  // namespace

result::Result<pddl::OutsideTask> read_skeletons(const pddl::Source& domain, const pddl::Source& problem) {
  auto task = pddl::parse_task(domain, problem);
  if (!task) return result::forward(task);
  return pddl::split_outside(*task, predicates::geometric_predicates());
}

TampOutcome plan(const scene::RobotCell& cell, const pddl::OutsideTask& task, const IntervalModel& model,
                 const TampOptions& options) {
  return SkeletonPlanning(cell, task, model, options).run();
}

}  // namespace stepwright::tamp::planner

#include "tests/support/pddl/exhaustive.h"

#include <algorithm>
#include <map>
#include <queue>
#include <set>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "supervisor/pddl/action/ground_action.h"
#include "supervisor/pddl/lifted/executor.h"
#include "supervisor/pddl/lifted/usage.h"

namespace stepwright::pddl::testing {
namespace {

struct Candidate {
  model::GroundAction action;
  BoundAction bound;
};

// Every action with every combination of objects of the right types, unless a static fact forbids it.
std::vector<Candidate> all_actions(const Task& task) {
  const Definition& definition = task.definition();
  std::vector<Candidate> actions;
  for (const Action& schema : definition.actions) {
    Binding binding(static_cast<std::size_t>(schema.slots), -1);
    for_each_binding(definition, schema.parameters, binding, [&] {
      model::GroundAction action{schema.name, {}};
      for (std::size_t i = 0; i < schema.parameters.size(); ++i) {
        action.arguments.push_back(definition.objects[static_cast<std::size_t>(binding[i])].name);
      }
      const auto info = inspect_action(task, action);
      for (const Requirement& requirement : info->preconditions) {
        if (requirement.kind == RequirementKind::Any && requirement.parts.empty()) return true;
      }
      Failure failure;
      actions.push_back({action, *bind(definition, action, failure)});
      return true;
    });
  }
  return actions;
}

// The part of a state that actions change, as plain vectors.
struct Dynamic {
  std::vector<Atom> facts;
  std::vector<double> values;  // of the changing fluents, the metric's own left out; NaN is not expected
  friend auto operator<=>(const Dynamic&, const Dynamic&) = default;
};

void find_replaced(const Effect& effect, std::set<int>& functions) {
  const bool counted = effect.change == ChangeKind::Increase || effect.change == ChangeKind::Decrease;
  if (effect.kind == EffectKind::Numeric && !counted) functions.insert(effect.call.symbol);
  for (const Effect& part : effect.parts) find_replaced(part, functions);
}

// The functions that only the metric reads and that actions only add to: they do not tell states apart.
std::set<int> counting_functions(const Definition& definition) {
  std::set<int> replaced;
  for (const Action& action : definition.actions) find_replaced(action.effect, replaced);
  std::set<int> counting = metric_only_functions(definition);
  std::erase_if(counting, [&](int function) { return replaced.count(function) != 0; });
  return counting;
}

// Takes states apart into what changes and what stays, and puts them together again.
class Splitter {
 public:
  explicit Splitter(const Task& task) : definition_(task.definition()), whole_(initial_state(definition_)) {
    const std::set<int> counting = counting_functions(definition_);
    for (const auto& [fluent, value] : whole_.fluents) {
      if (!definition_.functions[static_cast<std::size_t>(fluent.symbol)].changes) continue;
      (counting.count(fluent.symbol) != 0 ? counters_ : fluents_).push_back(fluent);
    }
    std::erase_if(whole_.facts, [&](const Atom& fact) { return changes(fact); });
  }

  Dynamic key(const LiftedState& state) const {
    Dynamic key;
    for (const Atom& fact : state.facts) {
      if (changes(fact)) key.facts.push_back(fact);
    }
    for (const Atom& fluent : fluents_) key.values.push_back(state.fluents.at(fluent));
    return key;
  }

  std::vector<double> counters(const LiftedState& state) const {
    std::vector<double> values;
    for (const Atom& fluent : counters_) values.push_back(state.fluents.at(fluent));
    return values;
  }

  LiftedState join(const Dynamic& key, const std::vector<double>& counters) const {
    LiftedState state = whole_;
    state.facts.insert(key.facts.begin(), key.facts.end());
    for (std::size_t i = 0; i < fluents_.size(); ++i) state.fluents[fluents_[i]] = key.values[i];
    for (std::size_t i = 0; i < counters_.size(); ++i) state.fluents[counters_[i]] = counters[i];
    return state;
  }

 private:
  bool changes(const Atom& fact) const {
    return definition_.predicates[static_cast<std::size_t>(fact.symbol)].changes;
  }

  const Definition& definition_;
  LiftedState whole_;
  std::vector<Atom> fluents_, counters_;
};

struct Best {
  double cost;
  std::size_t steps;
  std::vector<double> counters;
};
using Known = std::map<Dynamic, Best>;
using Entry = std::tuple<double, std::size_t, std::size_t, Known::iterator>;
struct Later {
  bool operator()(const Entry& a, const Entry& b) const {
    return std::tie(std::get<0>(a), std::get<1>(a), std::get<2>(a)) >
           std::tie(std::get<0>(b), std::get<1>(b), std::get<2>(b));
  }
};

// Can the metric fall along a plan although its counters only rise, because it reads the state too?
bool can_fall(const Definition& definition, const Expression& expression, const std::set<int>& counting) {
  if (expression.kind == NumericKind::Fluent) return counting.count(expression.call.symbol) == 0;
  return std::any_of(expression.operands.begin(), expression.operands.end(),
                     [&](const Expression& operand) { return can_fall(definition, operand, counting); });
}

// The metric of the state; without one, the number of steps.
double cost_of(const Definition& definition, const Executor& executor, std::size_t steps) {
  return definition.metric ? executor.cost().value() : static_cast<double>(steps);
}

}  // namespace

void for_each_reachable_state(const Task& task, std::size_t most_states,
                              const std::function<void(const LiftedState&)>& visit) {
  const Definition& definition = task.definition();
  const Splitter splitter(task);
  std::vector<Candidate> actions = all_actions(task);
  std::set<Dynamic> known;
  std::vector<LiftedState> open;
  const auto reach = [&](const LiftedState& state) {
    if (!known.insert(splitter.key(state)).second) return;
    if (known.size() > most_states) throw std::runtime_error("the task is too large to enumerate");
    visit(state);
    open.push_back(state);
  };
  reach(initial_state(definition));
  while (!open.empty()) {
    const LiftedState state = std::move(open.back());
    open.pop_back();
    for (const Candidate& candidate : actions) {
      Executor next(definition, state);
      if (!next.step(candidate.action)) reach(next.state());
    }
  }
}

std::optional<Optimum> exhaustive_optimum(const Task& task, std::size_t most_states) {
  const Definition& definition = task.definition();
  const Splitter splitter(task);
  std::vector<Candidate> actions = all_actions(task);
  Known known;
  std::priority_queue<Entry, std::vector<Entry>, Later> open;
  std::size_t order = 0;
  const bool all = definition.metric &&
                   can_fall(definition, definition.metric->expression, counting_functions(definition));
  std::optional<Optimum> best_goal;
  const auto visit = [&](const Executor& executor, std::size_t steps) {
    const double cost = cost_of(definition, executor, steps);
    const Best best{cost, steps, splitter.counters(executor.state())};
    const auto [place, added] = known.emplace(splitter.key(executor.state()), best);
    if (!added && std::tie(place->second.cost, place->second.steps) <= std::tie(cost, steps)) return;
    place->second = best;
    open.emplace(cost, steps, ++order, place);
  };
  visit(Executor(definition, initial_state(definition)), 0);
  while (!open.empty()) {
    const auto [cost, steps, number, place] = open.top();
    open.pop();
    if (std::tie(place->second.cost, place->second.steps) != std::tie(cost, steps)) continue;
    if (known.size() > most_states) throw std::runtime_error("the task is too large to enumerate");
    const LiftedState state = splitter.join(place->first, place->second.counters);
    Binding binding(static_cast<std::size_t>(definition.goal_slots), -1);
    if (holds(definition, definition.goal, binding, state)) {
      if (!best_goal || std::tie(cost, steps) < std::tie(best_goal->cost, best_goal->steps)) {
        best_goal = Optimum{cost, steps};
      }
      if (!all) break;
    }
    for (Candidate& candidate : actions) {
      if (!holds(definition, candidate.bound.action->precondition, candidate.bound.binding, state)) continue;
      Executor next(definition, state);
      if (!next.step(candidate.action)) visit(next, steps + 1);
    }
  }
  return best_goal;
}

}  // namespace stepwright::pddl::testing

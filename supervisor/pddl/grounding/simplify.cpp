#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "supervisor/pddl/grounding/fact_groups.h"
#include "supervisor/pddl/grounding/invariants.h"
#include "supervisor/pddl/grounding/raw_task.h"
#include "supervisor/pddl/grounding/relevance.h"
#include "supervisor/pddl/grounding/unreachable.h"

namespace stepwright::pddl {
namespace {

class Simplifier {
 public:
  explicit Simplifier(RawTask raw) : raw_(std::move(raw)), relevance_(find_relevance(raw_)) {}

  GroundTask run(const std::vector<Invariant>& invariants, const RoomFor& room_for) {
    task_.definition = raw_.definition;
    task_.maximize = raw_.definition->metric && raw_.definition->metric->maximize;
    number_facts();
    group_facts(invariants);
    number_variables();
    metric();
    goal();
    axioms();
    task_.cancelled = !operators(room_for);
    return std::move(task_);
  }

 private:
  // By action and arguments, whatever order they were found in; each raw one is let go once it is read.
  bool operators(const RoomFor& room_for) {
    const std::size_t most = raw_.operators.size();
    if (!room_for(most * (sizeof(std::size_t) + sizeof(GroundOperator)))) return false;
    std::vector<std::size_t> order;
    order.reserve(most);
    for (std::size_t i = 0; i < raw_.operators.size(); ++i) {
      if (raw_.reachable.operators[i]) order.push_back(i);
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const GroundOperator &left = raw_.operators[a], &right = raw_.operators[b];
      return std::tie(left.action, left.arguments) < std::tie(right.action, right.arguments);
    });
    task_.operators.reserve(order.size());
    for (const std::size_t i : order) add(std::exchange(raw_.operators[i], {}));
    return true;
  }

  bool reachable(std::size_t literal) const { return raw_.reachable.state.literals[literal]; }

  // A fact that always or never holds, or that nothing reads, gets no bit.
  void number_facts() {
    facts_.assign(raw_.facts.size(), -1);
    number_facts(false);
    task_.first_derived = static_cast<int>(task_.facts.size());
    number_facts(true);
  }

  void number_facts(bool derived) {
    for (std::size_t f = 0; f < raw_.facts.size(); ++f) {
      const bool changes = reachable(2 * f) && reachable(2 * f + 1);
      if (raw_.derived(f) != derived || !changes || !relevance_.facts[f]) continue;
      facts_[f] = static_cast<int>(task_.facts.size());
      task_.facts.push_back(raw_.facts[f]);
      task_.initial_facts.push_back(raw_.initial_facts[f]);
    }
  }

  void axioms() {
    for (const GroundAxiom& axiom : raw_.axioms) {
      const int fact = facts_[static_cast<std::size_t>(axiom.fact)];
      if (fact < 0 || !can_hold(axiom.body, raw_.reachable.state)) continue;
      GroundAxiom renumbered{fact, {}, axiom.layer};
      append(axiom.body, renumbered.body);
      if (!renumbered.body.impossible) task_.axioms.push_back(std::move(renumbered));
    }
    std::stable_sort(task_.axioms.begin(), task_.axioms.end(),
                     [](const GroundAxiom& a, const GroundAxiom& b) { return a.layer < b.layer; });
  }

  // A set that had facts without a bit may be without a fact that has one.
  void group_facts(const std::vector<Invariant>& invariants) {
    std::vector<FactGroup> sets;
    for (const Invariant& invariant : invariants) {
      FactGroup set{{}, invariant.exactly_one};
      for (const int fact : invariant.facts) {
        const int place = facts_[static_cast<std::size_t>(fact)];
        if (place >= 0) set.facts.push_back(place);
      }
      set.exactly_one = set.exactly_one && set.facts.size() == invariant.facts.size();
      sets.push_back(std::move(set));
    }
    for (const FactGroup& set : sets) {
      if (set.facts.size() > 1) task_.exclusive.push_back(set.facts);
    }
    task_.groups = choose_groups(std::move(sets), task_.facts.size());
  }

  void number_variables() {
    for (std::size_t v = 0; v < raw_.variables.size(); ++v) {
      const Interval range = raw_.reachable.state.values[v];
      const bool changes = !range.empty() && !(range == Interval::point(raw_.initial_values[v]));
      Replacement place{-1, raw_.initial_values[v], std::isnan(raw_.initial_values[v])};
      if (relevance_.kept[v] || (changes && relevance_.variables[v])) {
        place.variable = static_cast<int>(task_.variables.size());
        task_.variables.push_back(raw_.variables[v]);
        task_.bounds.push_back(range);
        task_.initial_values.push_back(raw_.initial_values[v]);
      }
      variables_.push_back(place);
    }
  }

  // The accumulated fluents leave the metric here: their initial amount is the base, their changes are costs.
  void metric() {
    GroundExpression rest = raw_.metric;
    for (const LinearTerm& term : raw_.metric.terms) {
      const auto v = static_cast<std::size_t>(term.variable);
      if (relevance_.weights[v] == 0.0) continue;
      task_.base_cost += term.coefficient * raw_.initial_values[v];
      rest = add_scaled(rest, -term.coefficient, variable_expression(term.variable));
    }
    task_.potential = substitute(rest, variables_);
  }

  // Each part that cannot hold is told, the first ones of many.
  void goal() {
    constexpr int kTold = 10;
    int unreachable = 0;
    std::string told;
    for (const RawGoal& part : raw_.goals) {
      append(part.condition, task_.goal);
      if (can_hold(part.condition, raw_.reachable.state) || ++unreachable > kTold) continue;
      told += (told.empty() ? "" : "; ") + why_unreachable(raw_, part);
    }
    if (unreachable > kTold) told += "; and " + std::to_string(unreachable - kTold) + " more";
    if (unreachable > 0) task_.unreachable_goal = std::move(told);
  }

  GroundExpression renumber(const GroundExpression& expression) const {
    return substitute(expression, variables_);
  }

  // Appends the condition in its new numbering, without what is decided.
  void append(const Condition& from, Condition& to) const {
    to.impossible = to.impossible || from.impossible;
    for (const int literal : from.literals) {
      const int fact = facts_[static_cast<std::size_t>(literal / 2)];
      if (fact >= 0) {
        to.literals.push_back(2 * fact + literal % 2);
      } else if (!reachable(static_cast<std::size_t>(literal))) {
        to.impossible = true;
      }
    }
    for (const Comparison& comparison : from.comparisons) {
      GroundExpression difference = renumber(comparison.difference);
      if (!difference.is_constant()) {
        to.comparisons.push_back({std::move(difference), comparison.relation});
      } else if (!compare(comparison.relation, difference.constant)) {
        to.impossible = true;
      }
    }
    for (const auto& options : from.choices) append_choice(options, to);
  }

  void append_choice(const std::vector<Condition>& options, Condition& to) const {
    std::vector<Condition> rest;
    for (const Condition& option : options) {
      Condition renumbered;
      append(option, renumbered);
      if (renumbered.always()) return;
      if (!renumbered.impossible) rest.push_back(std::move(renumbered));
    }
    if (rest.empty()) to.impossible = true;
    if (!rest.empty()) to.choices.push_back(std::move(rest));
  }

  void add(const GroundOperator& raw) {
    GroundOperator op;
    op.action = raw.action;
    op.arguments = raw.arguments;
    op.may_conflict = raw.may_conflict;
    append(raw.precondition, op.precondition);
    if (op.precondition.impossible) return;
    op.cost = raw_.definition->metric ? Interval::point(0.0) : Interval::point(1.0);
    for (const GroundEffect& effect : raw.effects) add_effect(raw, effect, op);
    if (!raw_.definition->metric) {
      if (op.effects.empty() || !op.effects.front().when.always()) op.effects.emplace(op.effects.begin());
      op.effects.front().cost.constant += 1.0;
    }
    if (changes_anything(op)) task_.operators.push_back(std::move(op));
  }

  static bool changes_anything(const GroundOperator& op) {
    for (const GroundEffect& effect : op.effects) {
      if (!effect.adds.empty() || !effect.deletes.empty() || !effect.numeric.empty()) return true;
    }
    return op.cost.low < 0.0;
  }

  void add_effect(const GroundOperator& raw, const GroundEffect& effect, GroundOperator& op) {
    GroundEffect renumbered;
    append(effect.when, renumbered.when);
    if (renumbered.when.impossible || !can_hold(effect.when, raw_.reachable.state)) return;
    for (const int fact : effect.adds) {
      const int place = facts_[static_cast<std::size_t>(fact)];
      if (place >= 0) renumbered.adds.push_back(place);
    }
    for (const int fact : effect.deletes) {
      const int place = facts_[static_cast<std::size_t>(fact)];
      if (place >= 0) renumbered.deletes.push_back(place);
    }
    GroundExpression cost;
    for (const NumericEffect& numeric : effect.numeric) {
      const auto v = static_cast<std::size_t>(numeric.variable);
      if (variables_[v].variable >= 0) {
        renumbered.numeric.push_back({variables_[v].variable, numeric.kind, renumber(numeric.amount)});
      } else if (relevance_.weights[v] != 0.0) {
        const double sign = numeric.kind == ChangeKind::Decrease ? -1.0 : 1.0;
        cost = add_scaled(cost, sign * relevance_.weights[v], numeric.amount);
      }
    }
    Interval range = implied_interval(cost, {&raw.precondition, &effect.when}, raw_.reachable.state.values);
    if (!renumbered.when.always()) range = hull(range, Interval::point(0.0));
    op.cost = op.cost + range;
    renumbered.cost = renumber(cost);
    op.effects.push_back(std::move(renumbered));
  }

  RawTask raw_;
  Relevance relevance_;
  GroundTask task_;
  std::vector<int> facts_;              // new number or -1
  std::vector<Replacement> variables_;  // new number or the constant
};

}  // namespace

GroundTask simplify(RawTask raw, const std::vector<Invariant>& invariants, const RoomFor& room_for) {
  return Simplifier(std::move(raw)).run(invariants, room_for);
}

}  // namespace stepwright::pddl

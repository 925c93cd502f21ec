#include "supervisor/pddl/grounding/compiler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "supervisor/pddl/definition/numeric.h"
#include "supervisor/pddl/lifted/evaluate.h"

namespace stepwright::pddl {
namespace {

void add_relation(GroundExpression difference, Relation relation, Condition& condition) {
  if (difference.is_constant()) {
    if (!compare(relation, difference.constant)) condition.impossible = true;
    return;
  }
  condition.comparisons.push_back({std::move(difference), relation});
}

bool conflicting(const GroundOperator& op) {
  if (op.effects.size() == 1 && op.effects[0].numeric.size() < 2) return false;
  std::map<int, int> changes, additive;
  for (const GroundEffect& effect : op.effects) {
    for (const NumericEffect& numeric : effect.numeric) {
      ++changes[numeric.variable];
      if (numeric.kind == ChangeKind::Increase || numeric.kind == ChangeKind::Decrease) {
        ++additive[numeric.variable];
      }
    }
  }
  return std::any_of(changes.begin(), changes.end(),
                     [&](const auto& c) { return c.second > 1 && additive[c.first] != c.second; });
}

}  // namespace

Compiler::Compiler(const Definition& definition, const std::function<bool()>& stop)
    : definition_(definition), stop_(stop) {
  for (const Atom& fact : definition.facts) initial_.intern(fact);
  for (const auto& [fluent, value] : definition.fluents) {
    fluents_.intern(fluent);
    values_.push_back(value);
  }
}

bool Compiler::time_to_stop() {
  constexpr std::uint64_t kBindingsBetweenChecks = 4096;
  if (!stopped_ && ++bindings_ % kBindingsBetweenChecks == 0) stopped_ = stop_();
  return stopped_;
}

std::span<const int> Compiler::objects(const Call& call, const Binding& binding) {
  objects_.clear();
  for (const Term& term : call.arguments) {
    objects_.push_back(term.variable ? binding[static_cast<std::size_t>(term.index)] : term.index);
  }
  return objects_;
}

GroundExpression Compiler::expression(const Expression& expression, const Binding& binding) {
  if (expression.kind == NumericKind::Constant) return constant_expression(expression.number);
  if (expression.kind == NumericKind::Fluent) {
    const int function = expression.call.symbol;
    const std::span<const int> arguments = objects(expression.call, binding);
    if (definition_.functions[static_cast<std::size_t>(function)].changes) {
      const bool has_value = fluents_.find(function, arguments) >= 0;
      const int number = variables_.intern(function, arguments);
      return has_value ? variable_expression(number) : partial_expression(number);
    }
    const int place = fluents_.find(function, arguments);
    return constant_expression(place < 0 ? std::numeric_limits<double>::quiet_NaN()
                                         : values_[static_cast<std::size_t>(place)]);
  }
  GroundExpression result = this->expression(expression.operands[0], binding);
  if (expression.kind == NumericKind::Negate) return combine(expression.kind, result, {});
  for (std::size_t i = 1; i < expression.operands.size(); ++i) {
    result = combine(expression.kind, result, this->expression(expression.operands[i], binding));
  }
  return result;
}

Condition Compiler::condition(const Formula& formula, Binding& binding) {
  Condition condition;
  add(formula, binding, true, condition);
  return condition;
}

void Compiler::add_atom(const Formula& formula, const Binding& binding, bool positive, Condition& condition) {
  const int predicate = formula.call.symbol;
  const std::span<const int> arguments = objects(formula.call, binding);
  if (definition_.predicates[static_cast<std::size_t>(predicate)].changes) {
    const int literal = 2 * facts_.intern(predicate, arguments) + (positive ? 0 : 1);
    auto& list = condition.literals;
    if (std::find(list.begin(), list.end(), literal) == list.end()) list.push_back(literal);
  } else if ((initial_.find(predicate, arguments) >= 0) != positive) {
    condition.impossible = true;
  }
}

void Compiler::add_comparison(const Formula& formula, const Binding& binding, bool positive,
                              Condition& condition) {
  GroundExpression difference = combine(NumericKind::Subtract, expression(formula.sides[0], binding),
                                        expression(formula.sides[1], binding));
  if (positive || formula.relation != Relation::Equal) {
    const Relation relation = positive ? formula.relation : opposite(formula.relation);
    add_relation(std::move(difference), relation, condition);
    return;
  }
  std::vector<Condition> sides(2);
  add_relation(difference, Relation::Less, sides[0]);
  add_relation(std::move(difference), Relation::Greater, sides[1]);
  add_choice(std::move(sides), condition);
}

void Compiler::add_choice(std::vector<Condition> options, Condition& condition) {
  std::erase_if(options, [](const Condition& option) { return option.impossible; });
  if (std::any_of(options.begin(), options.end(), [](const Condition& o) { return o.always(); })) return;
  if (options.empty()) {
    condition.impossible = true;
  } else if (options.size() > 1) {
    condition.choices.push_back(std::move(options));
  } else {
    Condition& only = options.front();
    const auto append = [](auto& to, auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(condition.literals, only.literals);
    append(condition.comparisons, only.comparisons);
    append(condition.choices, only.choices);
  }
}

void Compiler::add_parts(const Formula& formula, Binding& binding, bool positive, Condition& condition) {
  if (formula.variables.empty()) {
    for (std::size_t i = 0; i < formula.parts.size() && !condition.impossible; ++i) {
      const bool flip = formula.kind == FormulaKind::Imply && i == 0;
      add(formula.parts[i], binding, positive != flip, condition);
    }
    return;
  }
  for_each_binding(definition_, formula.variables, binding, [&] {
    add(formula.parts[0], binding, positive, condition);
    return !condition.impossible && !time_to_stop();
  });
}

std::vector<Condition> Compiler::options(const Formula& formula, Binding& binding, bool positive) {
  std::vector<Condition> list;
  // False once one option always holds: then the others do not matter.
  const auto option = [&](const Formula& part, bool sign) {
    list.emplace_back();
    add(part, binding, sign, list.back());
    if (list.back().impossible) list.pop_back();
    return list.empty() || !list.back().always();
  };
  if (!formula.variables.empty()) {
    for_each_binding(definition_, formula.variables, binding,
                     [&] { return option(formula.parts[0], positive) && !time_to_stop(); });
    return list;
  }
  bool open = true;
  for (std::size_t i = 0; i < formula.parts.size() && open; ++i) {
    open = option(formula.parts[i], positive != (formula.kind == FormulaKind::Imply && i == 0));
  }
  return list;
}

void Compiler::add(const Formula& formula, Binding& binding, bool positive, Condition& condition) {
  const bool conjunction = formula.kind == FormulaKind::And || formula.kind == FormulaKind::Forall;
  switch (formula.kind) {
    case FormulaKind::Atom:
      return add_atom(formula, binding, positive, condition);
    case FormulaKind::Compare:
      return add_comparison(formula, binding, positive, condition);
    case FormulaKind::Not:
      return add(formula.parts[0], binding, !positive, condition);
    case FormulaKind::SameObject: {
      const auto object = [&](const Term& t) {
        return t.variable ? binding[static_cast<std::size_t>(t.index)] : t.index;
      };
      if ((object(formula.terms[0]) == object(formula.terms[1])) != positive) condition.impossible = true;
      return;
    }
    default:
      break;
  }
  if (conjunction == positive) {
    add_parts(formula, binding, positive, condition);
  } else {
    add_choice(options(formula, binding, positive), condition);
  }
}

void Compiler::conditional(const Effect& effect, Binding& binding, std::size_t target, GroundOperator& op) {
  Condition when = op.effects[target].when;
  add(effect.condition[0], binding, true, when);
  if (when.impossible) return;
  op.effects.emplace_back();
  op.effects.back().when = std::move(when);
  effects(effect.parts[0], binding, op.effects.size() - 1, op);
}

void Compiler::effects(const Effect& effect, Binding& binding, std::size_t target, GroundOperator& op) {
  switch (effect.kind) {
    case EffectKind::And:
      for (const Effect& part : effect.parts) effects(part, binding, target, op);
      return;
    case EffectKind::Add:
      op.effects[target].adds.push_back(facts_.intern(effect.call.symbol, objects(effect.call, binding)));
      return;
    case EffectKind::Delete:
      op.effects[target].deletes.push_back(facts_.intern(effect.call.symbol, objects(effect.call, binding)));
      return;
    case EffectKind::When:
      return conditional(effect, binding, target, op);
    case EffectKind::Forall:
      for_each_binding(definition_, effect.variables, binding, [&] {
        effects(effect.parts[0], binding, target, op);
        return !time_to_stop();
      });
      return;
    case EffectKind::Numeric:
      op.effects[target].numeric.push_back(
          {variable(ground(effect.call, binding)), effect.change, expression(effect.amount[0], binding)});
      return;
  }
}

std::optional<GroundOperator> Compiler::compile(int action, Binding& binding) {
  const Action& schema = definition_.actions[static_cast<std::size_t>(action)];
  GroundOperator op;
  op.action = action;
  op.arguments.assign(binding.begin(),
                      binding.begin() + static_cast<std::ptrdiff_t>(schema.parameters.size()));
  add(schema.precondition, binding, true, op.precondition);
  if (op.precondition.impossible) return std::nullopt;
  op.effects.emplace_back();
  effects(schema.effect, binding, 0, op);
  for (const NumericEffect& effect : op.effects[0].numeric) {
    if (effect.amount.linear() && !std::isfinite(effect.amount.constant)) return std::nullopt;
  }
  if (definition_.total_time >= 0) {
    op.effects[0].numeric.push_back(
        {variable(Atom{definition_.total_time, {}}), ChangeKind::Increase, constant_expression(1.0)});
  }
  op.may_conflict = conflicting(op);
  return op;
}

std::optional<GroundAxiom> Compiler::compile(const Axiom& axiom, const std::vector<const Formula*>& conjuncts,
                                             Binding& binding) {
  GroundAxiom compiled;
  for (const Formula* conjunct : conjuncts) add(*conjunct, binding, true, compiled.body);
  if (compiled.body.impossible) return std::nullopt;
  const auto end = binding.begin() + static_cast<std::ptrdiff_t>(axiom.parameters.size());
  compiled.fact = fact(Atom{axiom.predicate, {binding.begin(), end}});
  compiled.layer = definition_.predicates[static_cast<std::size_t>(axiom.predicate)].layer;
  return compiled;
}

}  // namespace stepwright::pddl

#include "supervisor/pddl/semantics/formula_checker.h"

#include <algorithm>
#include <set>

#include "supervisor/lisp/name_hints.h"

namespace stepwright::pddl {

int FormulaChecker::type(const std::string& name, Place at) {
  const auto found = definition_.type_ids.find(name);
  if (found != definition_.type_ids.end()) return found->second;
  std::vector<std::string> names = lisp::names_of(definition_.type_ids);
  std::erase_if(names, [](const std::string& known) { return known.front() == '('; });
  reporter_.error("P0101", at, "unknown type '" + name + "'", lisp::did_you_mean(name, names));
  unknown_type_ = true;
  return 0;
}

// An either becomes a type of its own, without a parent, at its first use.
int FormulaChecker::type(const Typed& typed) {
  if (typed.either.empty()) return type(typed.type_name, typed.type_at);
  const auto found = definition_.type_ids.find(typed.type_name);
  if (found != definition_.type_ids.end()) return found->second;
  Type either{typed.type_name, typed.type_at, {}, typed.type_at, {}, {}};
  for (const std::string& name : typed.either) either.members.push_back(type(name, typed.type_at));
  const int id = static_cast<int>(definition_.types.size());
  definition_.types.push_back(std::move(either));
  definition_.type_ids.emplace(typed.type_name, id);
  std::vector<int>& objects = definition_.objects_by_type.emplace_back();
  for (std::size_t object = 0; object < definition_.objects.size(); ++object) {
    if (definition_.is_of_type(static_cast<int>(object), id)) objects.push_back(static_cast<int>(object));
  }
  return id;
}

std::vector<int> FormulaChecker::types(const Typed& object) {
  if (object.either.empty()) return {type(object.type_name, object.type_at)};
  std::vector<int> types;
  for (const std::string& name : object.either) types.push_back(type(name, object.type_at));
  return types;
}

void FormulaChecker::require(const std::string& flag, Place at) {
  if (definition_.requirements.count(flag) != 0 || warned_[flag]) return;
  warned_[flag] = true;
  reporter_.warning("P0110", at, "this needs the requirement '" + flag + "', which is not declared",
                    "add it to ':requirements'");
}

void FormulaChecker::begin(std::vector<Typed>& parameters) {
  scope_.clear();
  slots_ = 0;
  push(parameters);
}

void FormulaChecker::declaration(std::vector<Typed>& parameters) {
  std::set<std::string> names;
  for (Typed& parameter : parameters) {
    parameter.type = type(parameter);
    if (names.insert(parameter.name).second) continue;
    reporter_.warning("P0108", parameter.at, "the name '" + parameter.name + "' stands twice",
                      "these are two arguments all the same");
  }
}

// A variable of a quantifier hides one of the same name outside of it.
void FormulaChecker::push(std::vector<Typed>& variables) {
  const auto outside = static_cast<std::ptrdiff_t>(scope_.size());
  for (Typed& variable : variables) {
    variable.type = type(variable);
    variable.slot = slots_++;
    const auto same = [&](const Typed& other) { return other.name == variable.name; };
    if (std::any_of(scope_.begin() + outside, scope_.end(), same)) {
      reporter_.error("P0108", variable.at, "the variable '" + variable.name + "' is declared twice");
    } else if (std::any_of(scope_.begin(), scope_.begin() + outside, same)) {
      reporter_.warning("P0108", variable.at,
                        "the variable '" + variable.name + "' hides the one of that name outside",
                        "give it another name");
    }
    scope_.push_back(variable);
  }
}

void FormulaChecker::pop(std::size_t count) {
  scope_.resize(scope_.size() - count);
}

// Comparing with every name takes its time, which an error that is only counted is not worth.
std::string FormulaChecker::hint_for(const std::string& name, const std::map<std::string, int>& ids) const {
  return reporter_.full() ? std::string() : lisp::did_you_mean(name, lisp::names_of(ids));
}

bool FormulaChecker::unknown_object(const Term& term) {
  reporter_.error("P0104", term.at, "unknown object '" + term.name + "'",
                  hint_for(term.name, definition_.object_ids));
  return false;
}

bool FormulaChecker::resolve(Term& term, std::vector<int>& types) {
  if (!term.variable) {
    const auto found = definition_.object_ids.find(term.name);
    if (found == definition_.object_ids.end()) return unknown_object(term);
    term.index = found->second;
    types = definition_.objects[static_cast<std::size_t>(term.index)].types;
    return true;
  }
  const auto variable = std::find_if(scope_.rbegin(), scope_.rend(),
                                     [&](const Typed& known) { return known.name == term.name; });
  if (variable != scope_.rend()) {
    term.index = variable->slot;
    types = {variable->type};
    return true;
  }
  std::vector<std::string> names;
  for (const Typed& known : scope_) names.push_back(known.name);
  reporter_.error("P0105", term.at, "unknown variable '" + term.name + "'",
                  lisp::did_you_mean(term.name, names));
  return false;
}

bool FormulaChecker::resolve_symbol(Call& call, bool function) {
  const auto& ids = function ? definition_.function_ids : definition_.predicate_ids;
  const auto& others = function ? definition_.predicate_ids : definition_.function_ids;
  const auto found = ids.find(call.name);
  if (found != ids.end()) {
    call.symbol = found->second;
    return true;
  }
  std::string hint = hint_for(call.name, ids);
  if (others.count(call.name) != 0) {
    hint = "'" + call.name + (function ? "' is a predicate, it has no value" : "' is a function: compare it");
  }
  reporter_.error(function ? "P0103" : "P0102", call.at,
                  std::string(function ? "unknown function '" : "unknown predicate '") + call.name + "'",
                  hint);
  return false;
}

bool FormulaChecker::resolve(Call& call, bool function) {
  if (!resolve_symbol(call, function)) return false;
  const auto& table = function ? definition_.functions : definition_.predicates;
  const Symbol& symbol = table[static_cast<std::size_t>(call.symbol)];
  if (call.arguments.size() != symbol.parameters.size()) {
    reporter_.error("P0106", call.at,
                    "'" + call.name + "' takes " + std::to_string(symbol.parameters.size()) +
                        " argument(s), not " + std::to_string(call.arguments.size()));
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const int wanted = symbol.parameters[i].type;
    std::vector<int> found;
    if (!resolve(call.arguments[i], found)) {
      good = false;
    } else if (std::none_of(found.begin(), found.end(),
                            [&](int type) { return definition_.is_subtype(type, wanted); })) {
      wrong_type(call.arguments[i].name, call.arguments[i].at, name_of(found), call.name, i, wanted);
      good = false;
    }
  }
  return good;
}

int FormulaChecker::predicate(const std::string& name, Place at, std::size_t arity) {
  Call call;
  call.name = name;
  call.at = at;
  if (!resolve_symbol(call, false)) return -1;
  const Symbol& symbol = definition_.predicates[static_cast<std::size_t>(call.symbol)];
  if (symbol.parameters.size() == arity) return call.symbol;
  reporter_.error("P0106", at,
                  "'" + name + "' takes " + std::to_string(symbol.parameters.size()) + " argument(s), not " +
                      std::to_string(arity));
  return -1;
}

void FormulaChecker::arguments(const std::string& name, int predicate, const std::vector<Typed>& parameters) {
  const Symbol& symbol = definition_.predicates[static_cast<std::size_t>(predicate)];
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (definition_.is_subtype(parameters[i].type, symbol.parameters[i].type)) continue;
    wrong_type(parameters[i].name, parameters[i].at, name_of({parameters[i].type}), name, i,
               symbol.parameters[i].type);
  }
}

bool FormulaChecker::derived(const Call& fact, const std::string& changed) {
  if (!definition_.predicates[static_cast<std::size_t>(fact.symbol)].derived) return false;
  reporter_.error("P0115", fact.at, "'" + fact.name + "' is derived, it cannot be " + changed,
                  "only its ':derived' rules say where it holds");
  return true;
}

std::string FormulaChecker::name_of(const std::vector<int>& types) const {
  std::string text;
  for (const int type : types)
    text += (text.empty() ? "" : " and ") + definition_.types[static_cast<std::size_t>(type)].name;
  return text;
}

void FormulaChecker::wrong_type(const std::string& name, Place at, const std::string& found,
                                const std::string& symbol, std::size_t argument, int wanted) {
  // What was declared with a type that there is not has none of the wanted types, which is said already.
  if (unknown_type_ && found == definition_.types.front().name) return;
  reporter_.error("P0107", at,
                  "'" + name + "' is of type '" + found + "', but argument " + std::to_string(argument + 1) +
                      " of '" + symbol + "' is of type '" + name_of({wanted}) + "'");
}

bool FormulaChecker::ground(Call& call, bool function) {
  scope_.clear();
  return resolve(call, function);
}

void FormulaChecker::expression(Expression& expression) {
  for (std::size_t i = 1; i < expression.operands.size() && expression.kind == NumericKind::Divide; ++i) {
    const Expression& divisor = expression.operands[i];
    if (divisor.kind == NumericKind::Constant && divisor.number == 0.0) {
      reporter_.error("P0117", divisor.at, "the divisor is zero");
    }
  }
  if (expression.kind == NumericKind::Fluent) {
    require(":numeric-fluents", expression.at);
    resolve(expression.call, true);
  }
  for (Expression& operand : expression.operands) this->expression(operand);
}

void FormulaChecker::formula(Formula& formula) {
  std::vector<int> any;  // objects of any two types may be compared
  switch (formula.kind) {
    case FormulaKind::Atom:
      if (negated_) require(":negative-preconditions", formula.at);
      resolve(formula.call, false);
      break;
    case FormulaKind::SameObject:
      require(":equality", formula.at);
      for (Term& term : formula.terms) resolve(term, any);
      break;
    case FormulaKind::Compare:
      for (Expression& side : formula.sides) expression(side);
      break;
    case FormulaKind::Or:
    case FormulaKind::Imply:
      require(":disjunctive-preconditions", formula.at);
      break;
    case FormulaKind::Forall:
      require(":universal-preconditions", formula.at);
      push(formula.variables);
      break;
    case FormulaKind::Exists:
      require(":existential-preconditions", formula.at);
      push(formula.variables);
      break;
    case FormulaKind::And:
    case FormulaKind::Not:
      break;
  }
  const bool outer = negated_;
  if (formula.kind == FormulaKind::Not) negated_ = !negated_;
  for (Formula& part : formula.parts) this->formula(part);
  negated_ = outer;
  pop(formula.variables.size());
}

void FormulaChecker::numeric_effect(Effect& effect) {
  const bool cost =
      effect.call.name == kTotalCostName && definition_.requirements.count(":action-costs") != 0;
  if (!cost) require(":numeric-fluents", effect.at);
  if (resolve(effect.call, true)) {
    Symbol& function = definition_.functions[static_cast<std::size_t>(effect.call.symbol)];
    function.changes = true;
    function.assigned = function.assigned || effect.change == ChangeKind::Assign;
  }
  for (Expression& amount : effect.amount) expression(amount);
}

void FormulaChecker::effect(Effect& effect) {
  switch (effect.kind) {
    case EffectKind::Add:
    case EffectKind::Delete:
      if (resolve(effect.call, false) && !derived(effect.call, "changed by an action")) {
        definition_.predicates[static_cast<std::size_t>(effect.call.symbol)].changes = true;
      }
      break;
    case EffectKind::Numeric:
      numeric_effect(effect);
      break;
    case EffectKind::When:
      require(":conditional-effects", effect.at);
      formula(effect.condition[0]);
      break;
    case EffectKind::Forall:
      require(":conditional-effects", effect.at);
      push(effect.variables);
      break;
    case EffectKind::And:
      break;
  }
  for (Effect& part : effect.parts) this->effect(part);
  pop(effect.variables.size());
}

}  // namespace stepwright::pddl

#include "supervisor/htn/task/body_resolver.h"

#include <algorithm>

#include "supervisor/lisp/name_hints.h"

namespace stepwright::htn {
namespace {

ConditionKind kind_of(FormulaKind kind) {
  switch (kind) {
    case FormulaKind::Atom:
      return ConditionKind::Atom;
    case FormulaKind::Equal:
      return ConditionKind::Equal;
    case FormulaKind::And:
      return ConditionKind::And;
    case FormulaKind::Or:
      return ConditionKind::Or;
    case FormulaKind::Not:
      return ConditionKind::Not;
    case FormulaKind::Imply:
      return ConditionKind::Imply;
    case FormulaKind::Forall:
      return ConditionKind::Forall;
    case FormulaKind::Exists:
      return ConditionKind::Exists;
  }
  return ConditionKind::And;
}

}  // namespace

std::vector<Variable> BodyResolver::begin(const std::vector<TypedName>& parameters) {
  scope_.clear();
  slot_types_.clear();
  slots_ = 0;
  return push(parameters);
}

// A variable of a quantifier hides one of the same name outside of it.
std::vector<Variable> BodyResolver::push(const std::vector<TypedName>& variables) {
  const auto outside = static_cast<std::ptrdiff_t>(scope_.size());
  std::vector<Variable> pushed;
  for (const TypedName& parsed : variables) {
    const Variable variable{parsed.name, declarations_.type(parsed), slots_++};
    slot_types_.push_back(variable.type);
    const auto same = [&](const Variable& other) { return other.name == variable.name; };
    if (std::any_of(scope_.begin() + outside, scope_.end(), same)) {
      reporter_.error("P0108", parsed.at, "the variable '" + variable.name + "' is declared twice");
    } else if (std::any_of(scope_.begin(), scope_.begin() + outside, same)) {
      reporter_.warning("P0108", parsed.at,
                        "the variable '" + variable.name + "' hides the one of that name outside",
                        "give it another name");
    }
    scope_.push_back(variable);
    pushed.push_back(variable);
  }
  return pushed;
}

bool BodyResolver::term(const ParsedTerm& parsed, Term& term) {
  if (!parsed.variable) {
    const auto found = names_.objects.find(parsed.name);
    if (found != names_.objects.end()) {
      term = term_of_object(found->second);
      return true;
    }
    reporter_.error("P0104", parsed.at, "unknown object '" + parsed.name + "'",
                    reporter_.full() ? "" : lisp::did_you_mean(parsed.name, lisp::names_of(names_.objects)));
    return false;
  }
  const auto found =
      std::find_if(scope_.rbegin(), scope_.rend(), [&](const Variable& v) { return v.name == parsed.name; });
  if (found != scope_.rend()) {
    term = found->slot;
    return true;
  }
  std::vector<std::string> known;
  for (const Variable& variable : scope_) known.push_back(variable.name);
  reporter_.error("P0105", parsed.at, "unknown variable '" + parsed.name + "'",
                  lisp::did_you_mean(parsed.name, known));
  return false;
}

int BodyResolver::type_of(Term term) const {
  return term < 0 ? task_.objects[static_cast<std::size_t>(~term)].types.front()
                  : slot_types_[static_cast<std::size_t>(term)];
}

bool BodyResolver::fits(Term term, int wanted, Fit fit) const {
  if (term < 0) return task_.is_of_type(~term, wanted);
  const int type = type_of(term);
  return fit == Fit::Subtype ? task_.is_subtype(type, wanted) : task_.overlap(type, wanted);
}

bool BodyResolver::arguments(const ParsedCall& call, const std::vector<int>& types, Fit fit,
                             std::vector<Term>& terms) {
  if (call.arguments.size() != types.size()) {
    reporter_.error("P0106", call.at,
                    "'" + call.name + "' takes " + std::to_string(types.size()) + " argument(s), not " +
                        std::to_string(call.arguments.size()));
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < types.size(); ++i) {
    terms.emplace_back(0);
    if (!term(call.arguments[i], terms.back())) {
      good = false;
    } else if (!fits(terms.back(), types[i], fit)) {
      const auto name = [&](int type) { return task_.types[static_cast<std::size_t>(type)].name; };
      reporter_.error("P0107", call.arguments[i].at,
                      "'" + call.arguments[i].name + "' is of type '" + name(type_of(terms.back())) +
                          "', but argument " + std::to_string(i + 1) + " of '" + call.name +
                          "' is of type '" + name(types[i]) + "'");
      good = false;
    }
  }
  return good;
}

int BodyResolver::symbol(const ParsedCall& call, const std::map<std::string, int>& ids, const char* code,
                         const std::string& what) {
  const auto found = ids.find(call.name);
  if (found != ids.end()) return found->second;
  reporter_.error(code, call.at, "unknown " + what + " '" + call.name + "'",
                  reporter_.full() ? "" : lisp::did_you_mean(call.name, lisp::names_of(ids)));
  return -1;
}

bool BodyResolver::atom(const ParsedCall& call, Fit fit, int& predicate, std::vector<Term>& terms) {
  predicate = symbol(call, names_.predicates, "P0102", "predicate");
  return predicate >= 0 &&
         arguments(call, task_.predicates[static_cast<std::size_t>(predicate)].parameter_types, fit, terms);
}

bool BodyResolver::is_external(const ParsedCall& call) const {
  const auto found = names_.predicates.find(call.name);
  return found != names_.predicates.end() &&
         task_.predicates[static_cast<std::size_t>(found->second)].external;
}

void BodyResolver::refuse_external(const ParsedCall& call) {
  reporter_.error("P0607", call.at, "'" + call.name + "' is evaluated outside, which cannot be asked here",
                  "it may stand, negated or not, in the outermost conjunction of a condition or an effect");
}

Condition BodyResolver::inner(const ParsedFormula& formula) {
  Condition condition;
  condition.kind = kind_of(formula.kind);
  if (formula.kind == FormulaKind::Atom) {
    if (is_external(formula.call)) refuse_external(formula.call);
    atom(formula.call, Fit::Overlap, condition.symbol, condition.terms);
    return condition;
  }
  if (formula.kind == FormulaKind::Equal) {
    condition.terms.resize(2);
    for (std::size_t i = 0; i < 2; ++i) term(formula.call.arguments[i], condition.terms[i]);
    return condition;
  }
  condition.variables = push(formula.variables);
  for (const ParsedFormula& part : formula.parts) condition.parts.push_back(inner(part));
  pop(formula.variables.size());
  return condition;
}

void BodyResolver::outer(const ParsedFormula& formula, Condition& all,
                         std::vector<ExternalLiteral>& externals) {
  if (formula.kind == FormulaKind::And) {
    for (const ParsedFormula& part : formula.parts) outer(part, all, externals);
    return;
  }
  const bool negated = formula.kind == FormulaKind::Not && formula.parts[0].kind == FormulaKind::Atom;
  const ParsedFormula& literal = negated ? formula.parts[0] : formula;
  if (literal.kind != FormulaKind::Atom || !is_external(literal.call)) {
    all.parts.push_back(inner(formula));
    return;
  }
  ExternalLiteral external;
  external.positive = !negated;
  if (atom(literal.call, Fit::Overlap, external.predicate, external.terms))
    externals.push_back(std::move(external));
}

Condition BodyResolver::condition(const ParsedFormula& formula, std::vector<ExternalLiteral>& externals) {
  Condition all;
  outer(formula, all, externals);
  return all;
}

void BodyResolver::narrow(const std::vector<Term>& terms, const std::vector<int>& types, Condition& all) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (terms[i] < 0 || task_.is_subtype(type_of(terms[i]), types[i])) continue;
    Condition fits;
    fits.kind = ConditionKind::OfType;
    fits.symbol = types[i];
    fits.terms = {terms[i]};
    all.parts.push_back(std::move(fits));
  }
}

std::vector<Term> BodyResolver::task_terms(const ParsedCall& call, int task, Condition& types) {
  const std::vector<int>& wanted = task_.tasks[static_cast<std::size_t>(task)].parameter_types;
  std::vector<Term> terms;
  if (arguments(call, wanted, Fit::Overlap, terms)) narrow(terms, wanted, types);
  return terms;
}

bool BodyResolver::subtask(const ParsedCall& call, Subtask& subtask, Condition& types) {
  const auto action = names_.actions.find(call.name);
  subtask.primitive = action != names_.actions.end();
  std::vector<int> wanted;
  if (subtask.primitive) {
    subtask.symbol = action->second;
    for (const Variable& parameter : task_.actions[static_cast<std::size_t>(subtask.symbol)].parameters)
      wanted.push_back(parameter.type);
  } else {
    std::map<std::string, int> both =
        names_.tasks.contains(call.name) || reporter_.full() ? std::map<std::string, int>{} : names_.actions;
    if (both.empty()) {
      subtask.symbol = symbol(call, names_.tasks, "P0601", "task");
    } else {
      both.insert(names_.tasks.begin(), names_.tasks.end());
      subtask.symbol = symbol(call, both, "P0601", "task");
    }
    if (subtask.symbol < 0) return false;
    wanted = task_.tasks[static_cast<std::size_t>(subtask.symbol)].parameter_types;
  }
  if (!arguments(call, wanted, Fit::Overlap, subtask.terms)) return false;
  narrow(subtask.terms, wanted, types);
  return true;
}

bool BodyResolver::ground(const ParsedCall& call, bool function, GroundAtom& atom) {
  scope_.clear();
  atom.symbol = function ? symbol(call, names_.functions, "P0103", "function")
                         : symbol(call, names_.predicates, "P0102", "predicate");
  if (atom.symbol < 0) return false;
  const std::vector<Symbol>& table = function ? task_.functions : task_.predicates;
  std::vector<Term> terms;
  if (!arguments(call, table[static_cast<std::size_t>(atom.symbol)].parameter_types, Fit::Subtype, terms))
    return false;
  for (const Term term : terms) atom.objects.push_back(~term);
  return true;
}

}  // namespace stepwright::htn

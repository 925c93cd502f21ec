#include "supervisor/pddl/grounding/join_rule.h"

#include <algorithm>
#include <set>

#include "supervisor/pddl/lifted/alternatives.h"

namespace stepwright::pddl {
namespace {

constexpr std::size_t kMostAlternatives = 16;  // of an action

bool is_static(const Definition& definition, const Expression& expression) {
  if (expression.kind == NumericKind::Fluent &&
      definition.functions[static_cast<std::size_t>(expression.call.symbol)].changes) {
    return false;
  }
  return std::all_of(expression.operands.begin(), expression.operands.end(),
                     [&](const Expression& operand) { return is_static(definition, operand); });
}

bool changes(const Definition& definition, const Call& call) {
  return definition.predicates[static_cast<std::size_t>(call.symbol)].changes;
}

// Quantified conditions are left to the compiler.
bool is_static(const Definition& definition, const Formula& formula) {
  if (!formula.variables.empty()) return false;
  if (formula.kind == FormulaKind::Atom) return !changes(definition, formula.call);
  return std::all_of(formula.sides.begin(), formula.sides.end(),
                     [&](const Expression& side) { return is_static(definition, side); }) &&
         std::all_of(formula.parts.begin(), formula.parts.end(),
                     [&](const Formula& part) { return is_static(definition, part); });
}

void flatten(const Formula& formula, std::vector<const Formula*>& conjuncts) {
  if (formula.kind != FormulaKind::And) return conjuncts.push_back(&formula);
  for (const Formula& part : formula.parts) flatten(part, conjuncts);
}

// Variables behind the parameters that no conjunct reads.
void find_witnesses(std::size_t parameters, JoinRule& rule) {
  std::set<int> read;
  for (const Formula* conjunct : rule.conjuncts) collect_slots(*conjunct, read);
  for (std::size_t v = parameters; v < rule.variables.size(); ++v) {
    const int slot = rule.variables[v].slot;
    if (read.count(slot) == 0) rule.witnesses.push_back(slot);
  }
}

void add_filter(const Formula& formula, bool holds, JoinRule& rule) {
  std::set<int> slots;
  collect_slots(formula, slots);
  rule.filters.push_back({&formula, {slots.begin(), slots.end()}, holds});
}

void complete(const Definition& definition, JoinRule& rule) {
  for (const Formula* conjunct : rule.conjuncts) {
    if (conjunct->kind == FormulaKind::Atom) {
      const Call& call = conjunct->call;
      rule.atoms.push_back({call.symbol, &call.arguments, changes(definition, call)});
    } else if (is_static(definition, *conjunct)) {
      add_filter(*conjunct, true, rule);
    }
  }
  for (const Formula* formula : rule.ruled_out) add_filter(*formula, false, rule);
}

// The rules for the alternatives of the first disjunction that static facts decide, of all of them in turn;
// the rule itself if it has none, or too many.
void split(const Definition& definition, JoinRule rule, std::size_t most, std::vector<JoinRule>& rules) {
  const auto choice =
      std::find_if(rule.conjuncts.begin(), rule.conjuncts.end(), [&](const Formula* conjunct) {
        return conjunct->kind == FormulaKind::Or && is_static(definition, *conjunct);
      });
  if (choice == rule.conjuncts.end() || (*choice)->parts.size() > most)
    return rules.push_back(std::move(rule));
  const std::vector<Formula>& parts = (*choice)->parts;
  rule.conjuncts.erase(choice);
  for (const Formula& part : parts) {
    JoinRule alternative = rule;
    flatten(part, alternative.conjuncts);
    split(definition, std::move(alternative), most / parts.size(), rules);
    rule.ruled_out.push_back(&part);
  }
}

}  // namespace

std::vector<JoinRule> join_rules(const Definition& definition) {
  std::vector<JoinRule> rules;
  for (std::size_t a = 0; a < definition.actions.size(); ++a) {
    const Action& action = definition.actions[a];
    JoinRule rule;
    rule.action = static_cast<int>(a);
    rule.variables = action.parameters;
    rule.slots = action.slots;
    flatten(action.precondition, rule.conjuncts);
    split(definition, std::move(rule), kMostAlternatives, rules);
  }
  for (std::size_t a = 0; a < definition.axioms.size(); ++a) {
    const Axiom& axiom = definition.axioms[a];
    if (!definition.predicates[static_cast<std::size_t>(axiom.predicate)].changes) continue;
    for (Alternative& alternative : alternatives(axiom.body)) {
      JoinRule rule;
      rule.axiom = static_cast<int>(a);
      rule.variables = axiom.parameters;
      rule.variables.insert(rule.variables.end(), alternative.variables.begin(), alternative.variables.end());
      rule.conjuncts = std::move(alternative.conjuncts);
      rule.slots = axiom.slots;
      find_witnesses(axiom.parameters.size(), rule);
      rules.push_back(std::move(rule));
    }
  }
  for (JoinRule& rule : rules) complete(definition, rule);
  return rules;
}

}  // namespace stepwright::pddl

#include "supervisor/pddl/search/pruning/exchange_text.h"

#include <algorithm>
#include <cstring>

namespace stepwright::pddl {
namespace {

template <typename T>
void append(const T& value, std::string& text) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  text.append(bytes, sizeof(T));
}
void append(const std::string& part, std::string& text) {
  append(part.size(), text);
  text += part;
}
template <typename T>
void append_sorted(std::vector<T>& parts, std::string& text) {
  std::sort(parts.begin(), parts.end());
  append(parts.size(), text);
  for (const T& part : parts) append(part, text);
}

}  // namespace

std::string ExchangeText::text(const GroundOperator& op) const {
  std::string text = this->text(op.precondition);
  std::vector<std::string> effects;
  for (const GroundEffect& effect : op.effects) effects.push_back(this->text(effect));
  append_sorted(effects, text);
  return text;
}

std::string ExchangeText::text(const GroundAxiom& axiom) const {
  std::string text;
  append(fact(axiom.fact), text);
  append(axiom.layer, text);
  return text + this->text(axiom.body);
}

std::string ExchangeText::text(const Condition& condition) const {
  std::string text(condition.impossible ? "i" : "c");
  std::vector<int> literals;
  for (const int literal : condition.literals) literals.push_back(2 * fact(literal / 2) + literal % 2);
  append_sorted(literals, text);
  std::vector<std::string> parts;
  for (const Comparison& comparison : condition.comparisons) {
    std::string& part = parts.emplace_back(this->text(comparison.difference));
    append(comparison.relation, part);
  }
  append_sorted(parts, text);
  parts.clear();
  for (const auto& options : condition.choices) {
    std::vector<std::string> ways;
    for (const Condition& option : options) ways.push_back(this->text(option));
    append_sorted(ways, parts.emplace_back());
  }
  append_sorted(parts, text);
  return text;
}

std::string ExchangeText::text(const GroundExpression& expression) const {
  std::string text;
  std::vector<std::string> terms;
  for (const LinearTerm& term : expression.terms) {
    std::string& part = terms.emplace_back();
    append(variable(term.variable), part);
    append(term.coefficient, part);
  }
  append_sorted(terms, text);
  append(expression.constant, text);
  append(expression.program.size(), text);
  for (const NumericOperation& operation : expression.program) {
    append(operation.kind, text);
    append(operation.constant, text);
    append(operation.variable < 0 ? -1 : variable(operation.variable), text);
  }
  return text;
}

std::string ExchangeText::text(const GroundEffect& effect) const {
  std::string text = this->text(effect.when);
  for (const std::vector<int>* list : {&effect.adds, &effect.deletes}) {
    std::vector<int> facts;
    for (const int f : *list) facts.push_back(fact(f));
    append_sorted(facts, text);
  }
  std::vector<std::string> changes;
  for (const NumericEffect& numeric : effect.numeric) {
    std::string& change = changes.emplace_back();
    append(variable(numeric.variable), change);
    append(numeric.kind, change);
    change += this->text(numeric.amount);
  }
  append_sorted(changes, text);
  return text + this->text(effect.cost);
}

}  // namespace stepwright::pddl

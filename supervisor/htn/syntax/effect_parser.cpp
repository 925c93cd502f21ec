// The effects of FormulaParser.

#include "supervisor/htn/syntax/formula_parser.h"

namespace stepwright::htn {

using lisp::TokenKind;

bool FormulaParser::effect(ParsedEffect& effect) {
  if (tokens_.too_deep()) return false;
  effect.at = tokens_.peek().at;
  if (!tokens_.expect(TokenKind::Open, "an effect in parentheses")) return false;
  if (tokens_.accept(TokenKind::Close)) return true;
  std::string head;
  if (!tokens_.expect_name("a predicate or an effect", head, effect.call.at)) return false;
  return effect_body(effect, head);
}

bool FormulaParser::effect_body(ParsedEffect& effect, const std::string& head) {
  if (head == "and") {
    while (!tokens_.at(TokenKind::Close)) {
      effect.parts.emplace_back();
      if (!this->effect(effect.parts.back())) return false;
    }
    return close();
  }
  if (head == "not") {
    effect.kind = EffectKind::Delete;
    return call(effect.call) && close();
  }
  if (head == "when") {
    effect.kind = EffectKind::When;
    effect.condition.resize(1);
    effect.parts.resize(1);
    return formula(effect.condition[0]) && this->effect(effect.parts[0]) && close();
  }
  if (head == "forall") {
    effect.parts.resize(1);
    if (!parameters(effect.variables)) return false;
    effect.kind = effect.variables.empty() ? EffectKind::And : EffectKind::Forall;
    return this->effect(effect.parts[0]) && close();
  }
  if (head == "increase") return cost(effect);
  if (head == "assign" || head == "decrease" || head == "scale-up" || head == "scale-down") {
    tokens_.reporter().error("P0008", effect.call.at, "'" + head + "' is not supported here",
                             "the one number that changes is total-cost, by 'increase'");
    return false;
  }
  effect.kind = EffectKind::Add;
  effect.call.name = head;
  return arguments(effect.call);
}

// "(increase (total-cost) 5)", "(increase (total-cost) (road-length ?a ?b))".
bool FormulaParser::cost(ParsedEffect& effect) {
  effect.kind = EffectKind::Cost;
  const bool bare = tokens_.at(TokenKind::Name, "total-cost");
  if (bare) {
    tokens_.take();
  } else {
    ParsedCall changed;
    if (!call(changed)) return false;
    if (changed.name != "total-cost" || !changed.arguments.empty()) {
      tokens_.reporter().error("P0008", changed.at, "'" + changed.name + "' cannot change",
                               "the one number that changes is (total-cost)");
      return false;
    }
  }
  effect.amount.at = tokens_.peek().at;
  if (tokens_.at(TokenKind::Number)) {
    effect.amount.number = tokens_.take().number;
  } else if (!call(effect.amount.function)) {
    return false;
  }
  return close();
}

}  // namespace stepwright::htn

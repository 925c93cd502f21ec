// The effects of FormulaParser.

#include "supervisor/pddl/syntax/formula_parser.h"

namespace stepwright::pddl {

bool FormulaParser::effect(Effect& effect) {
  if (tokens_.too_deep()) return false;
  effect.at = tokens_.peek().at;
  if (!tokens_.expect(TokenKind::Open, "an effect in parentheses")) return false;
  if (tokens_.accept(TokenKind::Close)) return true;
  std::string head;
  if (!tokens_.expect_name("a predicate or an effect", head, effect.call.at)) return false;
  return effect_body(effect, head);
}

bool FormulaParser::effect_body(Effect& effect, const std::string& head) {
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
    if (!quantifier(effect.variables)) return false;
    effect.kind = effect.variables.empty() ? EffectKind::And : EffectKind::Forall;
    return this->effect(effect.parts[0]) && close();
  }
  if (head == "assign") return numeric_effect(effect, ChangeKind::Assign);
  if (head == "increase") return numeric_effect(effect, ChangeKind::Increase);
  if (head == "decrease") return numeric_effect(effect, ChangeKind::Decrease);
  if (head == "scale-up") return numeric_effect(effect, ChangeKind::ScaleUp);
  if (head == "scale-down") return numeric_effect(effect, ChangeKind::ScaleDown);
  effect.kind = EffectKind::Add;
  effect.call.name = head;
  return arguments(effect.call);
}

bool FormulaParser::numeric_effect(Effect& effect, ChangeKind change) {
  effect.kind = EffectKind::Numeric;
  effect.change = change;
  effect.amount.resize(1);
  if (tokens_.at(TokenKind::Name)) {  // "(increase total-cost 1)": accepted, as other planners do.
    effect.call.at = tokens_.peek().at;
    effect.call.name = tokens_.take().text;
  } else if (!call(effect.call)) {
    return false;
  }
  return expression(effect.amount[0]) && close();
}

}  // namespace stepwright::pddl

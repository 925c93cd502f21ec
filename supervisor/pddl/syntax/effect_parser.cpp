// The effects of FormulaParser that change numbers.

#include "supervisor/pddl/syntax/formula_parser.h"

namespace stepwright::pddl {

std::optional<bool> FormulaParser::change(Effect& effect, const std::string& head) {
  if (head == "assign") return numeric_effect(effect, ChangeKind::Assign);
  if (head == "increase") return numeric_effect(effect, ChangeKind::Increase);
  if (head == "decrease") return numeric_effect(effect, ChangeKind::Decrease);
  if (head == "scale-up") return numeric_effect(effect, ChangeKind::ScaleUp);
  if (head == "scale-down") return numeric_effect(effect, ChangeKind::ScaleDown);
  return std::nullopt;
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

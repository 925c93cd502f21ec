// The effects of FormulaParser that change the cost.

#include "supervisor/htn/syntax/formula_parser.h"

namespace stepwright::htn {

using lisp::TokenKind;

std::optional<bool> FormulaParser::change(ParsedEffect& effect, const std::string& head) {
  if (head == "increase") return cost(effect);
  if (head == "assign" || head == "decrease" || head == "scale-up" || head == "scale-down") {
    tokens_.reporter().error("P0008", effect.call.at, "'" + head + "' is not supported here",
                             "the one number that changes is total-cost, by 'increase'");
    return false;
  }
  return std::nullopt;
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

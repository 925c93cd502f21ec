#include "supervisor/ltl/hoa/label_reader.h"

namespace stepwright::ltl {

Diagram::Node LabelReader::several(std::size_t depth, bool all) {
  const auto operand = [&] { return all ? one(depth) : several(depth, true); };
  Diagram::Node label = operand();
  while (scanner_.accept(all ? '&' : '|'))
    label = all ? diagram_.both(label, operand()) : diagram_.either(label, operand());
  return label;
}

Diagram::Node LabelReader::one(std::size_t depth) {
  if (depth > limits_.nesting) {
    scanner_.fail("L0026", HoaToken(scanner_.peek()),
                  "more than " + std::to_string(limits_.nesting) + " parentheses in each other",
                  "write the label as a disjunction of conjunctions");
    return Diagram::kFalse;
  }
  bool negated = false;
  while (scanner_.accept('!')) negated = !negated;
  const HoaToken token = scanner_.peek();
  Diagram::Node label = Diagram::kFalse;
  if (scanner_.accept('(')) {
    label = several(depth + 1, false);
    if (!scanner_.accept(')')) scanner_.fail_here("')'");
  } else if (token.kind == HoaTokenKind::Word && (token.text == "t" || token.text == "f")) {
    scanner_.take();
    label = token.text == "t" ? Diagram::kTrue : Diagram::kFalse;
  } else if (token.kind == HoaTokenKind::Number && token.number < propositions_) {
    scanner_.take();
    label = diagram_.variable(token.number);
  } else if (token.kind == HoaTokenKind::Alias && aliases_.contains(token.text)) {
    scanner_.take();
    label = aliases_.at(token.text);
  } else {
    scanner_.fail_here("t, f, a number below that of AP:, an alias that was defined, or '('");
  }
  return negated ? diagram_.negation(label) : label;
}

}  // namespace stepwright::ltl

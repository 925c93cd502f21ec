#include "supervisor/ltl/hoa/label_reader.h"

namespace stepwright::ltl {

Diagram::Node LabelReader::several(std::size_t depth, bool all) {
  const auto operand = [&] { return all ? one(depth) : several(depth, true); };
  Diagram::Node label = operand();
  while (_scanner.accept(all ? '&' : '|'))
    label = all ? _diagram.both(label, operand()) : _diagram.either(label, operand());
  return label;
}

Diagram::Node LabelReader::one(std::size_t depth) {
  if (depth > _limits.nesting) {
    _scanner.fail("L0026", HoaToken(_scanner.peek()),
                  "more than " + std::to_string(_limits.nesting) + " parentheses in each other",
                  "write the label as a disjunction of conjunctions");
    return Diagram::kFalse;
  }
  bool negated = false;
  while (_scanner.accept('!')) negated = !negated;
  const HoaToken token = _scanner.peek();
  Diagram::Node label = Diagram::kFalse;
  if (_scanner.accept('(')) {
    label = several(depth + 1, false);
    if (!_scanner.accept(')')) _scanner.fail_here("')'");
  } else if (token.kind == HoaTokenKind::Word && (token.text == "t" || token.text == "f")) {
    _scanner.take();
    label = token.text == "t" ? Diagram::kTrue : Diagram::kFalse;
  } else if (token.kind == HoaTokenKind::Number && token.number < _propositions) {
    _scanner.take();
    label = _diagram.variable(token.number);
  } else if (token.kind == HoaTokenKind::Alias && _aliases.contains(token.text)) {
    _scanner.take();
    label = _aliases.at(token.text);
  } else {
    _scanner.fail_here("t, f, a number below that of AP:, an alias that was defined, or '('");
  }
  return negated ? _diagram.negation(label) : label;
}

}  // namespace stepwright::ltl

#include "supervisor/ltl/monitor/timer_text.h"

namespace stepwright::ltl {

namespace {

std::string timer_name(const std::string& name) {
  return name + "_timer";
}
std::string waiting_name(const std::string& name) {
  return name + "_open";
}

// A formula of one letter in ST. As deep as the parser lets formulas be.
std::string condition(const SyntaxTree& tree, SyntaxId node, const std::vector<std::string>& names) {
  const SyntaxNode& at = tree.nodes[node];
  const auto child = [&](std::size_t k) { return condition(tree, at.children[k], names); };
  const auto list = [&](const char* word) {
    std::string text = "(";
    for (std::size_t k = 0; k < at.children.size(); ++k) text += (k == 0 ? "" : word) + child(k);
    return text + ")";
  };
  switch (at.op) {
    case Operator::True:
      return "TRUE";
    case Operator::Name:
      return names[at.proposition];
    case Operator::Not:
      return "(NOT " + child(0) + ")";
    case Operator::And:
      return list(" AND ");
    case Operator::Or:
      return list(" OR ");
    case Operator::Xor:
      return list(" XOR ");
    case Operator::Iff:
      return "(NOT " + list(" XOR ") + ")";
    case Operator::Implies:
      return "(NOT " + child(0) + " OR " + child(1) + ")";
    default:
      return "FALSE";
  }
}

// Milliseconds are the smallest unit that durations of formulas have.
std::string literal(const Timed& timed) {
  return "T#" + std::to_string(timed.duration_ns / 1'000'000'000) + "s" +
         std::to_string(timed.duration_ns / 1'000'000 % 1'000) + "ms";
}

}  // namespace

std::string timer_declarations(const Timed& timed, const std::string& name) {
  const std::string waiting =
      timed.kind == TimedKind::Overdue ? "  " + waiting_name(name) + " : BOOL;\n" : "";
  return "  " + timer_name(name) + " : TON;\n" + waiting;
}

std::string timer_step(const SyntaxTree& tree, const Timed& timed, const std::vector<std::string>& names) {
  const std::string& name = names[timed.proposition];
  std::string text, on = "TRUE";
  if (timed.kind == TimedKind::Held) on = condition(tree, timed.of, names);
  if (timed.kind == TimedKind::Overdue) {
    on = waiting_name(name);
    text = on + " := (" + on + " OR " + condition(tree, timed.of, names) + ") AND NOT " +
           condition(tree, timed.answer, names) + ";\n";
  }
  return text + timer_name(name) + "(IN := " + on + ", PT := " + literal(timed) + ");\n" + name +
         " := " + timer_name(name) + ".Q;\n";
}

std::string timer_reset(const Timed& timed, const std::string& name) {
  const std::string waiting =
      timed.kind == TimedKind::Overdue ? "  " + waiting_name(name) + " := FALSE;\n" : "";
  return waiting + "  " + timer_name(name) + "(IN := FALSE, PT := " + literal(timed) + ");\n  " + name +
         " := FALSE;\n";
}

}  // namespace stepwright::ltl

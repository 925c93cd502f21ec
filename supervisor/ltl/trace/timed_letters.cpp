#include "supervisor/ltl/trace/timed_letters.h"

#include <algorithm>

namespace stepwright::ltl {

// As deep as the parser lets formulas be.
bool satisfies(const SyntaxTree& tree, SyntaxId node, Letter letter) {
  const SyntaxNode& at = tree.nodes[node];
  const auto child = [&](SyntaxId id) { return satisfies(tree, id, letter); };
  switch (at.op) {
    case Operator::True:
      return true;
    case Operator::Name:
      return (letter >> at.proposition & 1) != 0;
    case Operator::Not:
      return !child(at.children[0]);
    case Operator::And:
      return std::ranges::all_of(at.children, child);
    case Operator::Or:
      return std::ranges::any_of(at.children, child);
    case Operator::Xor:
      return child(at.children[0]) != child(at.children[1]);
    case Operator::Iff:
      return child(at.children[0]) == child(at.children[1]);
    case Operator::Implies:
      return !child(at.children[0]) || child(at.children[1]);
    default:
      return false;
  }
}

Letter TimedLetters::with_timed(Letter letter, std::int64_t time_ns) {
  for (std::size_t k = 0; k < timers_.size(); ++k) {
    const Timed& timed = tree_.timed[k];
    Timer& timer = timers_[k];
    bool on = true;
    if (timed.kind == TimedKind::Held) on = satisfies(tree_, timed.of, letter);
    if (timed.kind == TimedKind::Overdue) {
      timer.waiting =
          (timer.waiting || satisfies(tree_, timed.of, letter)) && !satisfies(tree_, timed.answer, letter);
      on = timer.waiting;
    }
    if (on && !timer.on) timer.since_ns = time_ns;
    timer.on = on;
    if (on && time_ns - timer.since_ns >= timed.duration_ns) letter |= Letter{1} << timed.proposition;
  }
  return letter;
}

}  // namespace stepwright::ltl

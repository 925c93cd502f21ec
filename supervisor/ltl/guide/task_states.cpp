#include "supervisor/ltl/guide/task_states.h"

#include <algorithm>

namespace stepwright::ltl {

namespace {

constexpr std::uint32_t kMuch = 1'000'000;

std::uint32_t sum_of(std::uint32_t a, std::uint32_t b) {
  return std::min(kMuch, a + b);
}

// Of each term: an Until is one place and whatever is asked together with it.
std::vector<std::uint32_t> needs_of(const Terms& terms) {
  std::vector<std::uint32_t> needs(terms.size(), 0);
  for (Term term = 0; term < terms.size(); ++term) {
    const auto operands = terms.operands(term);
    switch (terms.kind(term)) {
      case TermKind::False:
        needs[term] = kMuch;
        break;
      case TermKind::And:
        for (const Term each : operands) needs[term] = sum_of(needs[term], needs[each]);
        break;
      case TermKind::Or:
        needs[term] = kMuch;
        for (const Term each : operands) needs[term] = std::min(needs[term], needs[each]);
        break;
      case TermKind::Next:
        needs[term] = sum_of(1, needs[operands[0]]);
        break;
      case TermKind::Until:
        needs[term] = sum_of(1, needs[operands[1]]);
        break;
      default:
        break;
    }
  }
  return needs;
}

}  // namespace

// The cheapest path of the state's diagram to True: an obligation counts where it is met.
std::uint32_t TaskStates::left(std::uint32_t state) const {
  if (automaton_ != nullptr) return std::min(kMuch, automaton_->distance[state]);
  if (needs_->of_term.empty()) needs_->of_term = needs_of(progression_->terms());
  auto& known = needs_->of_state;
  known[Diagram::kTrue] = 0;
  known[Diagram::kFalse] = kMuch;
  const Diagram& diagram = progression_->diagram();
  std::vector<std::uint32_t> open = {state};
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    if (known.contains(node)) {
      open.pop_back();
      continue;
    }
    const auto low = known.find(diagram.low(node)), high = known.find(diagram.high(node));
    if (low == known.end()) open.push_back(diagram.low(node));
    if (high == known.end()) open.push_back(diagram.high(node));
    if (open.back() != node) continue;
    const std::uint32_t need = std::max(1u, needs_->of_term[progression_->obligation(node)]);
    const std::uint32_t least = std::min(low->second, sum_of(high->second, need));
    known.emplace(node, least);
    open.pop_back();
  }
  return known[state];
}

}  // namespace stepwright::ltl

#include "supervisor/ltl/automaton/guards.h"

#include <algorithm>
#include <unordered_set>

namespace stepwright::ltl {

Guard Guards::make(std::uint32_t proposition, Guard low, Guard high) {
  if (low == high) return low;
  const GuardNode node{proposition, low, high};
  const auto [known, added] = unique_.emplace(node, static_cast<Guard>(nodes_.size()));
  if (added) nodes_.push_back(node);
  return known->second;
}

std::uint32_t Guards::next(Guard from, Letter letter) const {
  while (!is_state(from)) {
    const GuardNode& node = nodes_[from];
    from = (letter >> node.proposition & 1) != 0 ? node.high : node.low;
  }
  return state_of(from);
}

void Guards::collect(Guard from, std::vector<std::uint32_t>& states) const {
  std::vector<Guard> open = {from};
  std::unordered_set<Guard> seen;
  while (!open.empty()) {
    const Guard top = open.back();
    open.pop_back();
    if (!seen.insert(top).second) continue;
    if (is_state(top)) {
      states.push_back(state_of(top));
    } else {
      open.push_back(nodes_[top].high);
      open.push_back(nodes_[top].low);
    }
  }
}

// At most one level per proposition.
Guard GuardRewriter::operator()(Guard guard) {
  if (is_state(guard)) return guard_of_state(states_[state_of(guard)]);
  if (const auto known = done_.find(guard); known != done_.end()) return known->second;
  const GuardNode& node = from_.nodes()[guard];
  const Guard low = (*this)(node.low), high = (*this)(node.high);
  const Guard made = to_.make(node.proposition, low, high);
  done_.emplace(guard, made);
  return made;
}

}  // namespace stepwright::ltl

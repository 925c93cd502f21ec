#include "supervisor/ltl/automaton/guards.h"

#include <algorithm>
#include <unordered_set>

namespace stepwright::ltl {

Guard Guards::make(std::uint32_t proposition, Guard low, Guard high) {
  if (low == high) return low;
  const GuardNode node{proposition, low, high};
  const auto [known, added] = _unique.emplace(node, static_cast<Guard>(_nodes.size()));
  if (added) _nodes.push_back(node);
  return known->second;
}

std::uint32_t Guards::next(Guard from, Letter letter) const {
  while (!is_state(from)) {
    const GuardNode& node = _nodes[from];
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
      open.push_back(_nodes[top].high);
      open.push_back(_nodes[top].low);
    }
  }
}

// At most one level per proposition.
Guard GuardRewriter::operator()(Guard guard) {
  if (is_state(guard)) return guard_of_state(_states[state_of(guard)]);
  if (const auto known = _done.find(guard); known != _done.end()) return known->second;
  const GuardNode& node = _from.nodes()[guard];
  const Guard low = (*this)(node.low), high = (*this)(node.high);
  const Guard made = _to.make(node.proposition, low, high);
  _done.emplace(guard, made);
  return made;
}

}  // namespace stepwright::ltl

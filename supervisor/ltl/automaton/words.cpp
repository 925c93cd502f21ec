#include "supervisor/ltl/automaton/words.h"

#include <algorithm>
#include <deque>
#include <unordered_set>
#include <utility>

namespace stepwright::ltl {
namespace {

// Each state that a guard leads to, with a letter that does it.
std::vector<std::pair<std::uint32_t, Letter>> ends_of(const Guards& guards, Guard from, Letter never) {
  std::vector<std::pair<std::uint32_t, Letter>> ends;
  std::vector<std::pair<Guard, Letter>> open = {{from, 0}};
  std::unordered_set<Guard> seen = {from};
  while (!open.empty()) {
    const auto [guard, letter] = open.back();
    open.pop_back();
    if (is_state(guard)) {
      ends.emplace_back(state_of(guard), letter);
      continue;
    }
    const GuardNode& node = guards.nodes()[guard];
    const Letter bit = Letter{1} << node.proposition;
    if ((never & bit) == 0 && seen.insert(node.high).second) open.emplace_back(node.high, letter | bit);
    if (seen.insert(node.low).second) open.emplace_back(node.low, letter);
  }
  return ends;
}

}  // namespace

std::optional<std::vector<Letter>> shortest_word(const Automaton& automaton, std::uint32_t from,
                                                 std::uint32_t to, Letter never) {
  struct Reached {
    std::uint32_t before = Automaton::kNever;
    Letter letter = 0;
  };
  std::vector<std::optional<Reached>> reached(automaton.size());
  reached[from] = Reached{};
  std::deque<std::uint32_t> open = {from};
  while (!open.empty() && !reached[to]) {
    const std::uint32_t state = open.front();
    open.pop_front();
    for (const auto& [next, letter] : ends_of(automaton.guards, automaton.edges[state], never)) {
      if (reached[next]) continue;
      reached[next] = Reached{state, letter};
      open.push_back(next);
    }
  }
  if (!reached[to]) return std::nullopt;
  std::vector<Letter> word;
  for (std::uint32_t at = to; at != from; at = reached[at]->before) word.push_back(reached[at]->letter);
  std::ranges::reverse(word);
  return word;
}

}  // namespace stepwright::ltl

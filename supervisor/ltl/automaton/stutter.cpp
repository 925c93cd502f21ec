#include <algorithm>
#include <set>
#include <utility>

#include "supervisor/ltl/automaton/automaton.h"

namespace stepwright::ltl {

namespace {

// Looks for a letter that leads to `target` and from there on to another state.
class Repetition {
 public:
  Repetition(const Guards& guards, std::uint32_t target) : guards_(guards), target_(guard_of_state(target)) {}

  bool changes(Guard first, Guard second, Letter& letter) {
    if (is_state(first) && (first != target_ || second == target_)) return false;
    if (is_state(first) && is_state(second)) return true;
    if (!seen_.insert({first, second}).second) return false;
    const std::uint32_t asked = std::min(asks(first), asks(second));
    if (changes(part(first, asked, false), part(second, asked, false), letter)) return true;
    if (!changes(part(first, asked, true), part(second, asked, true), letter)) return false;
    letter |= Letter{1} << asked;
    return true;
  }

 private:
  std::uint32_t asks(Guard guard) const {
    return is_state(guard) ? 0xFFFFFFFF : guards_.nodes()[guard].proposition;
  }
  Guard part(Guard guard, std::uint32_t proposition, bool value) const {
    if (asks(guard) != proposition) return guard;
    return value ? guards_.nodes()[guard].high : guards_.nodes()[guard].low;
  }

  const Guards& guards_;
  Guard target_;
  std::set<std::pair<Guard, Guard>> seen_;
};

}  // namespace

StutterAnswer stutter(const Automaton& automaton) {
  StutterAnswer answer;
  for (std::uint32_t state = 0; state < automaton.size(); ++state) {
    std::vector<std::uint32_t> after;
    automaton.guards.collect(automaton.edges[state], after);
    for (const std::uint32_t target : after) {
      Letter letter = 0;
      if (!Repetition(automaton.guards, target)
               .changes(automaton.edges[state], automaton.edges[target], letter))
        continue;
      answer.invariant = false;
      answer.state = state;
      answer.example = letter;
      return answer;
    }
  }
  return answer;
}

}  // namespace stepwright::ltl

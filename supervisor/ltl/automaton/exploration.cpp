#include "supervisor/ltl/automaton/exploration.h"

namespace stepwright::ltl {

Exploration::Exploration(Progression& progression, const BuildOptions& options)
    : _progression(progression), _options(options), _restricted(options.letters == Letters::AtMostOne) {
  if (!_restricted) return;
  _forbidden =
      _progression.diagram().variable(Diagram::kNoLevel - 1);  // below all obligations, and none of them
}

std::uint32_t Exploration::number(Progression::State state) {
  const auto [known, added] = _numbers.emplace(state, static_cast<std::uint32_t>(_states.size()));
  if (added) _states.push_back(state);
  return known->second;
}

// As deep as there are propositions.
Guard Exploration::guard(Diagram::Node node) {
  if (_progression.is_state(node)) return guard_of_state(number(node));
  if (const auto known = _known.find(node); known != _known.end()) return known->second;
  const Diagram& diagram = _progression.diagram();
  const Guard low = guard(diagram.low(node)), high = guard(diagram.high(node));
  const Guard made = _guards.make(diagram.level(node), low, high);
  _known.emplace(node, made);
  return made;
}

// One way for no proposition, and one for each alone.
Guard Exploration::guard_of_single_letters(Progression::State state) {
  const auto propositions = static_cast<std::uint32_t>(_progression.propositions());
  const Guard forbidden = guard_of_state(number(_forbidden));
  Guard none = guard_of_state(number(_progression.next(state, 0)));
  for (std::uint32_t level = propositions; level-- > 0;) {
    Guard alone = guard_of_state(number(_progression.next(state, Letter{1} << level)));
    for (std::uint32_t other = propositions; --other > level;) alone = _guards.make(other, alone, forbidden);
    none = _guards.make(level, none, alone);
  }
  return none;
}

bool Exploration::run() {
  number(_progression.start());
  for (std::uint32_t k = 0; k < _states.size(); ++k) {
    const Progression::State state = _states[k];
    const bool stays = state <= Diagram::kTrue || state == _forbidden;
    if (!stays && !_restricted) {
      const Diagram::Node after = _progression.successors(state);
      if (_progression.exhausted()) return false;
      _edges.push_back(guard(after));
    } else {
      _edges.push_back(stays ? guard_of_state(k) : guard_of_single_letters(state));
    }
    if (_progression.exhausted() || too_many_states()) return false;
  }
  return true;
}

Reach Exploration::reach() const {
  Reach reach(_states.size());
  for (std::uint32_t k = 0; k < _states.size(); ++k) {
    std::vector<std::uint32_t> after;
    _guards.collect(_edges[k], after);
    for (const std::uint32_t each : after)
      if (!_restricted || _states[each] != _forbidden) reach.add(k, each);
  }
  return reach;
}

}  // namespace stepwright::ltl

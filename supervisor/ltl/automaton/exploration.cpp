#include "supervisor/ltl/automaton/exploration.h"

namespace stepwright::ltl {

Exploration::Exploration(Progression& progression, const BuildOptions& options)
    : progression_(progression), options_(options), restricted_(options.letters == Letters::AtMostOne) {
  if (!restricted_) return;
  forbidden_ =
      progression_.diagram().variable(Diagram::kNoLevel - 1);  // below all obligations, and none of them
}

std::uint32_t Exploration::number(Progression::State state) {
  const auto [known, added] = numbers_.emplace(state, static_cast<std::uint32_t>(states_.size()));
  if (added) states_.push_back(state);
  return known->second;
}

// As deep as there are propositions. Beyond the bound nothing is looked at any more: one edge alone may lead
// to more states than there may be.
Guard Exploration::guard(Diagram::Node node) {
  if (too_many_states()) return guard_of_state(0);
  if (progression_.is_state(node)) return guard_of_state(number(node));
  if (const auto known = known_.find(node); known != known_.end()) return known->second;
  const Diagram& diagram = progression_.diagram();
  const Guard low = guard(diagram.low(node)), high = guard(diagram.high(node));
  const Guard made = guards_.make(diagram.level(node), low, high);
  known_.emplace(node, made);
  return made;
}

// One way for no proposition, and one for each alone.
Guard Exploration::guard_of_single_letters(Progression::State state) {
  const auto propositions = static_cast<std::uint32_t>(progression_.propositions());
  const Guard forbidden = guard_of_state(number(forbidden_));
  Guard none = guard_of_state(number(progression_.next(state, 0)));
  for (std::uint32_t level = propositions; level-- > 0;) {
    Guard alone = guard_of_state(number(progression_.next(state, Letter{1} << level)));
    for (std::uint32_t other = propositions; --other > level;) alone = guards_.make(other, alone, forbidden);
    none = guards_.make(level, none, alone);
  }
  return none;
}

bool Exploration::run() {
  number(progression_.start());
  for (std::uint32_t k = 0; k < states_.size(); ++k) {
    const Progression::State state = states_[k];
    const bool stays = state <= Diagram::kTrue || state == forbidden_;
    if (!stays && !restricted_) {
      const Diagram::Node after = progression_.successors(state);
      if (progression_.exhausted()) return false;
      edges_.push_back(guard(after));
    } else {
      edges_.push_back(stays ? guard_of_state(k) : guard_of_single_letters(state));
    }
    if (progression_.exhausted() || too_many_states()) return false;
  }
  return true;
}

Reach Exploration::reach() const {
  Reach reach(states_.size());
  for (std::uint32_t k = 0; k < states_.size(); ++k) {
    std::vector<std::uint32_t> after;
    guards_.collect(edges_[k], after);
    for (const std::uint32_t each : after)
      if (!restricted_ || states_[each] != forbidden_) reach.add(k, each);
  }
  return reach;
}

}  // namespace stepwright::ltl

#include "supervisor/ltl/automaton/automaton.h"

#include <algorithm>

namespace stepwright::ltl {

std::vector<std::uint32_t> Automaton::successors(std::uint32_t state) const {
  std::vector<std::uint32_t> found;
  guards.collect(edges[state], found);
  std::erase_if(found, [&](std::uint32_t each) { return rejecting(each); });
  return found;
}

std::optional<std::uint32_t> Automaton::proposition(const std::string& name) const {
  const auto found = std::ranges::find(propositions, name);
  if (found == propositions.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - propositions.begin());
}

}  // namespace stepwright::ltl

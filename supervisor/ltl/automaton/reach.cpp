#include "supervisor/ltl/automaton/reach.h"

namespace stepwright::ltl {

void Reach::add(std::uint32_t from, std::uint32_t to) {
  before_[to].push_back(from);
  ++outgoing_[from];
}

std::vector<bool> Reach::closed(std::vector<bool> seeds, bool every) const {
  std::vector<std::uint32_t> open, left = outgoing_;
  for (std::uint32_t k = 0; k < seeds.size(); ++k)
    if (seeds[k]) open.push_back(k);
  while (!open.empty()) {
    const std::uint32_t state = open.back();
    open.pop_back();
    for (const std::uint32_t each : before_[state]) {
      if (seeds[each] || (every && --left[each] != 0)) continue;
      seeds[each] = true;
      open.push_back(each);
    }
  }
  return seeds;
}

}  // namespace stepwright::ltl

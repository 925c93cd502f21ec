#include "supervisor/pddl/search/space/number_table.h"

#include "runtime/base/hash64.h"

namespace stepwright::pddl {

std::size_t NumberTable::slot_of(Word bits) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t place = base::hash_mix(0, bits) & mask;
  while (slots_[place] != kFree && numbers_[slots_[place]] != bits) place = (place + 1) & mask;
  return place;
}

std::uint32_t NumberTable::index_of(Word bits) {
  const std::size_t place = slot_of(bits);
  if (slots_[place] != kFree) return slots_[place];
  const auto index = static_cast<std::uint32_t>(numbers_.size());
  numbers_.push_back(bits);
  slots_[place] = index;
  if (2 * numbers_.size() > slots_.size()) grow();
  return index;
}

void NumberTable::grow() {
  slots_.assign(2 * slots_.size(), kFree);
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    slots_[slot_of(numbers_[i])] = static_cast<std::uint32_t>(i);
  }
}

}  // namespace stepwright::pddl

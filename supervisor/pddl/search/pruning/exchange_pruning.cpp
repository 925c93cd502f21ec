#include "supervisor/pddl/search/pruning/exchange_pruning.h"

#include <algorithm>

#include "supervisor/pddl/search/pruning/object_mentions.h"

namespace stepwright::pddl {

ExchangePruning::ExchangePruning(const StateSpace& space, const Interchangeable& objects)
    : objects_(objects),
      first_(space.task().definition->objects.size(), -1),
      needless_(space.fact_words(), 0),
      arranged_(space.words()),
      met_(space) {
  std::vector<bool> in_set(first_.size(), false);
  for (const ExchangeSet& set : objects_.sets()) {
    for (const ExchangeMember& member : set.members) in_set[static_cast<std::size_t>(member.object)] = true;
  }
  const ObjectMentions mentions(space.task());
  for (std::size_t op = 0; op < space.task().operators.size(); ++op) {
    std::vector<int> list = mentions.objects(static_cast<int>(op));
    std::erase_if(list, [&](int object) { return !in_set[static_cast<std::size_t>(object)]; });
    mentions_.append(list);
  }
}

void ExchangePruning::look_at(const Word* state) {
  for (const Twin& twin : twins_) first_[static_cast<std::size_t>(twin.object)] = -1;
  objects_.find_twins(state, twins_);
  std::fill(needless_.begin(), needless_.end(), Word{0});
  any_needless_ = false;
  for (const Twin& twin : twins_) {
    first_[static_cast<std::size_t>(twin.object)] = twin.first;
    if (twin.facts == nullptr) continue;
    any_needless_ = true;
    for (const int fact : *twin.facts)
      needless_[static_cast<std::size_t>(fact) >> 6] |= Word{1} << (fact & 63);
  }
}

// With the first twin in the object's place it is an operator that leads to a state like its own. One that
// mentions both is kept.
bool ExchangePruning::needless(int op) const {
  const auto list = mentions_[static_cast<std::size_t>(op)];
  return std::any_of(list.begin(), list.end(), [&](int object) {
    const int first = first_[static_cast<std::size_t>(object)];
    return first >= 0 && std::find(list.begin(), list.end(), first) == list.end();
  });
}

void ExchangePruning::leave_out(std::vector<int>& operators) const {
  if (!twins_.empty()) std::erase_if(operators, [this](int op) { return needless(op); });
}

bool ExchangePruning::meet(const Word* state) {
  std::copy(state, state + arranged_.size(), arranged_.begin());
  objects_.arrange(arranged_.data());
  return met_.insert(arranged_.data()).second;
}

}  // namespace stepwright::pddl

#include "supervisor/htn/search/state.h"

namespace stepwright::htn {

namespace {

const std::vector<int> kNoFacts;

std::uint64_t hash_of_key(std::span<const int> key) {
  std::uint64_t hash = 1;
  for (const int object : key) hash = scramble(hash ^ static_cast<std::uint32_t>(object));
  return hash;
}

}  // namespace

State::State(const PlanningTask& task) : true_(task.predicates.size()), indexes_of_(task.predicates.size()) {
  for (const GroundAtom& atom : task.facts) set(fact(atom.symbol, atom.objects), true);
  trail_.clear();
}

int State::fact(int predicate, std::span<const int> objects) {
  const int number = facts_.intern(predicate, objects);
  if (static_cast<std::size_t>(number) == place_.size()) {
    place_.push_back(-1);
    for (const std::size_t index : indexes_of_[static_cast<std::size_t>(predicate)])
      add(indexes_[index], number);
  }
  return number;
}

bool State::holds(int predicate, std::span<const int> objects) const {
  const int number = facts_.find(predicate, objects);
  return number >= 0 && holds(number);
}

void State::flip(int fact) {
  std::vector<int>& list = true_[static_cast<std::size_t>(predicate(fact))];
  int& place = place_[static_cast<std::size_t>(fact)];
  if (place < 0) {
    place = static_cast<int>(list.size());
    list.push_back(fact);
  } else {
    place_[static_cast<std::size_t>(list.back())] = place;
    list[static_cast<std::size_t>(place)] = list.back();
    list.pop_back();
    place = -1;
  }
  fingerprint_ ^= fingerprint_of(static_cast<std::uint64_t>(fact));
}

void State::set(int fact, bool value) {
  if (holds(fact) == value) return;
  flip(fact);
  trail_.push_back(fact);
}

void State::undo(std::size_t mark) {
  while (trail_.size() > mark) {
    flip(trail_.back());
    trail_.pop_back();
  }
}

void State::add(Index& index, int fact) {
  std::vector<int> key;
  const std::span<const int> all = objects(fact);
  for (std::size_t column = 0; column < all.size() && column < 64; ++column)
    if ((index.columns >> column & 1) != 0) key.push_back(all[column]);
  index.lists[hash_of_key(key)].push_back(fact);
}

const std::vector<int>& State::candidates(int predicate, std::uint64_t columns, std::span<const int> key) {
  const std::vector<int>& all = true_[static_cast<std::size_t>(predicate)];
  constexpr std::size_t kFew = 8;
  if (columns == 0 || all.size() <= kFew) return all;
  std::vector<std::size_t>& mine = indexes_of_[static_cast<std::size_t>(predicate)];
  Index* found = nullptr;
  for (const std::size_t index : mine)
    if (indexes_[index].columns == columns) found = &indexes_[index];
  if (found == nullptr) {
    mine.push_back(indexes_.size());
    indexes_.push_back({predicate, columns, {}});
    found = &indexes_.back();
    for (int fact = 0; fact < static_cast<int>(place_.size()); ++fact)
      if (this->predicate(fact) == predicate) add(*found, fact);
  }
  const auto list = found->lists.find(hash_of_key(key));
  if (list == found->lists.end()) return kNoFacts;
  return list->second.size() < all.size() ? list->second : all;
}

}  // namespace stepwright::htn

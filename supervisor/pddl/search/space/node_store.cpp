#include "supervisor/pddl/search/space/node_store.h"

#include <algorithm>

#include "runtime/base/hash64.h"

namespace stepwright::pddl {

NodeStore::NodeStore(std::size_t words) : words_(words), table_(256) {}

std::uint64_t NodeStore::hash(const Word* state) const {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < words_; ++i) value = base::hash_mix(value, state[i]);
  return value;
}

// The slot of the state, or the free one where it belongs. Comparing the tags first keeps most wrong states
// untouched.
std::size_t NodeStore::locate(const Word* state, std::uint64_t hash) const {
  const std::size_t mask = table_.size() - 1;
  const auto tag = static_cast<std::uint32_t>(hash >> 32);
  for (std::size_t place = hash & mask;; place = (place + 1) & mask) {
    const Slot& slot = table_[place];
    if (slot.node == kNoNode) return place;
    if (slot.tag == tag && std::equal(state, state + words_, this->state(slot.node))) return place;
  }
}

std::pair<std::uint32_t, bool> NodeStore::insert(const Word* state) {
  if (3 * (size_ + 1) > 2 * table_.size()) grow();
  const std::uint64_t key = hash(state);
  Slot& slot = table_[locate(state, key)];
  if (slot.node != kNoNode) return {slot.node, false};
  if (size_ % kBlock == 0) {
    states_.emplace_back().reserve(kBlock * words_);
    nodes_.emplace_back().reserve(kBlock);
  }
  const auto node = static_cast<std::uint32_t>(size_++);
  slot = {node, static_cast<std::uint32_t>(key >> 32)};
  states_.back().insert(states_.back().end(), state, state + words_);
  nodes_.back().emplace_back();
  return {node, true};
}

std::uint32_t NodeStore::find(const Word* state) const {
  return table_[locate(state, hash(state))].node;
}

void NodeStore::grow() {
  std::vector<Slot> table(2 * table_.size());
  const std::size_t mask = table.size() - 1;
  for (std::uint32_t node = 0; node < size_; ++node) {
    const std::uint64_t key = hash(state(node));
    std::size_t place = key & mask;
    while (table[place].node != kNoNode) place = (place + 1) & mask;
    table[place] = {node, static_cast<std::uint32_t>(key >> 32)};
  }
  table_ = std::move(table);
}

std::size_t NodeStore::memory() const {
  return states_.size() * kBlock * (words_ * sizeof(Word) + sizeof(Node)) + table_.capacity() * sizeof(Slot);
}

std::vector<int> NodeStore::path(std::uint32_t node) const {
  std::vector<int> operators;
  for (; (*this)[node].parent != kNoNode; node = (*this)[node].parent) operators.push_back((*this)[node].op);
  std::reverse(operators.begin(), operators.end());
  return operators;
}

}  // namespace stepwright::pddl

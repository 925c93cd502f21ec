#include "supervisor/pddl/search/node_store.h"

#include <algorithm>

#include "runtime/base/hash64.h"

namespace stepwright::pddl {

NodeStore::NodeStore(std::size_t words) : words_(words), table_(1024, kNoNode) {}

std::uint64_t NodeStore::hash(const Word* state) const {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < words_; ++i) value = base::hash_mix(value, state[i]);
  return value;
}

std::pair<std::uint32_t, bool> NodeStore::insert(const Word* state) {
  if (2 * (nodes_.size() + 1) > table_.size()) grow();
  const std::size_t mask = table_.size() - 1;
  for (std::size_t place = hash(state) & mask;; place = (place + 1) & mask) {
    const std::uint32_t node = table_[place];
    if (node == kNoNode) {
      const auto added = static_cast<std::uint32_t>(nodes_.size());
      table_[place] = added;
      nodes_.emplace_back();
      states_.insert(states_.end(), state, state + words_);
      return {added, true};
    }
    if (std::equal(state, state + words_, this->state(node))) return {node, false};
  }
}

std::uint32_t NodeStore::find(const Word* state) const {
  const std::size_t mask = table_.size() - 1;
  for (std::size_t place = hash(state) & mask;; place = (place + 1) & mask) {
    const std::uint32_t node = table_[place];
    if (node == kNoNode || std::equal(state, state + words_, this->state(node))) return node;
  }
}

void NodeStore::grow() {
  std::vector<std::uint32_t> table(2 * table_.size(), kNoNode);
  const std::size_t mask = table.size() - 1;
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    std::size_t place = hash(state(node)) & mask;
    while (table[place] != kNoNode) place = (place + 1) & mask;
    table[place] = node;
  }
  table_ = std::move(table);
}

std::size_t NodeStore::memory() const {
  return states_.capacity() * sizeof(Word) + nodes_.capacity() * sizeof(Node) +
         table_.capacity() * sizeof(std::uint32_t);
}

std::vector<int> NodeStore::path(std::uint32_t node) const {
  std::vector<int> operators;
  for (; nodes_[node].parent != kNoNode; node = nodes_[node].parent) operators.push_back(nodes_[node].op);
  std::reverse(operators.begin(), operators.end());
  return operators;
}

}  // namespace stepwright::pddl

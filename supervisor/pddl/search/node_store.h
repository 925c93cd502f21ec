#pragma once

// The states that a search has met, each once, with the best way to it known so far.
//
// Thread rule: one search, one store. Pointers to states are valid until the next `insert`.

#include <cstdint>
#include <utility>
#include <vector>

#include "supervisor/pddl/search/state_space.h"

namespace stepwright::pddl {

inline constexpr std::uint32_t kNoNode = UINT32_MAX;

struct Node {
  double cost = 0.0;  // accumulated
  std::uint32_t parent = kNoNode;
  std::int32_t op = -1;
  std::uint32_t steps = 0;
  bool closed = false;
};

class NodeStore {
 public:
  explicit NodeStore(std::size_t words);

  // The number of a known state, or kNoNode.
  std::uint32_t find(const Word* state) const;

  // The number of the state and whether it is new.
  std::pair<std::uint32_t, bool> insert(const Word* state);

  const Word* state(std::uint32_t node) const { return states_.data() + node * words_; }
  Node& operator[](std::uint32_t node) { return nodes_[node]; }
  const Node& operator[](std::uint32_t node) const { return nodes_[node]; }
  std::size_t size() const { return nodes_.size(); }

  // Bytes held.
  std::size_t memory() const;

  // The operators from the root to the node.
  std::vector<int> path(std::uint32_t node) const;

 private:
  struct Slot {
    std::uint32_t node = kNoNode;  // kNoNode: free
    std::uint32_t tag = 0;         // upper half of the hash
  };

  std::uint64_t hash(const Word* state) const;
  std::size_t locate(const Word* state, std::uint64_t hash) const;
  void grow();

  std::size_t words_;
  std::vector<Word> states_;
  std::vector<Node> nodes_;
  std::vector<Slot> table_;  // open addressing
};

}  // namespace stepwright::pddl

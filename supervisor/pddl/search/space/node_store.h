#pragma once

// The states that a search has met, each once, with the best way to it known so far. Storage grows by blocks,
// so that nothing is copied when it grows and the bytes held are the bytes used.
//
// Thread rule: one search, one store. Pointers to states stay valid.

#include <cstdint>
#include <utility>
#include <vector>

#include "supervisor/pddl/search/space/packed_bits.h"

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

  const Word* state(std::uint32_t node) const {
    return states_[node >> kBlockBits].data() + (node & (kBlock - 1)) * words_;
  }
  Node& operator[](std::uint32_t node) { return nodes_[node >> kBlockBits][node & (kBlock - 1)]; }
  const Node& operator[](std::uint32_t node) const { return nodes_[node >> kBlockBits][node & (kBlock - 1)]; }
  std::size_t size() const { return size_; }

  // Bytes held.
  std::size_t memory() const;

  // The operators from the root to the node.
  std::vector<int> path(std::uint32_t node) const;

 private:
  static constexpr std::uint32_t kBlockBits = 10;
  static constexpr std::uint32_t kBlock = 1u << kBlockBits;
  struct Slot {
    std::uint32_t node = kNoNode;  // kNoNode: free
    std::uint32_t tag = 0;         // upper half of the hash
  };

  std::uint64_t hash(const Word* state) const;
  std::size_t locate(const Word* state, std::uint64_t hash) const;
  void grow();

  std::size_t words_;
  std::size_t size_ = 0;
  std::vector<std::vector<Word>> states_;  // blocks with room for all their states
  std::vector<std::vector<Node>> nodes_;
  std::vector<Slot> table_;  // open addressing
};

}  // namespace stepwright::pddl

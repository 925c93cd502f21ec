#pragma once

// The states of a search, stored packed, each once, with the best way to it known so far.
//
// Thread rule: one search, one table.
//
//   auto [node, added] = states.insert(state);
//   states.load(node, state);

#include "supervisor/pddl/search/space/node_store.h"
#include "supervisor/pddl/search/space/state_codec.h"
#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl {

class StateTable {
 public:
  explicit StateTable(const StateSpace& space)
      : space_(space),
        codec_(space.task(), space.domains()),
        nodes_(codec_.words()),
        packed_(codec_.words()) {}

  // The number of the state and whether it is new.
  std::pair<std::uint32_t, bool> insert(const Word* state) {
    codec_.pack(state, packed_.data());
    return nodes_.insert(packed_.data());
  }

  // Writes the node's state.
  void load(std::uint32_t node, Word* state) const {
    codec_.unpack(nodes_.state(node), state);
    space_.derive(state);
  }

  Node& operator[](std::uint32_t node) { return nodes_[node]; }
  const Node& operator[](std::uint32_t node) const { return nodes_[node]; }
  std::size_t size() const { return nodes_.size(); }
  std::vector<int> path(std::uint32_t node) const { return nodes_.path(node); }

  // Forgets all states; how they are packed stays.
  void clear() { nodes_ = NodeStore(codec_.words()); }

  // Bytes held.
  std::size_t memory() const { return nodes_.memory() + codec_.memory(); }

 private:
  const StateSpace& space_;
  StateCodec codec_;
  NodeStore nodes_;
  std::vector<Word> packed_;
};

}  // namespace stepwright::pddl

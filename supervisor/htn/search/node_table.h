#pragma once

// Nodes of a search, and what is known of each: pairs of a network and a state.
//
// Thread rule: a container like any other.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "supervisor/htn/search/fingerprint.h"

namespace stepwright::htn {

enum class NodeStatus : std::uint8_t {
  Unknown,
  Open,         // on the path to the present one, at `depth`
  Conditional,  // no plan from here but through the open node at `depth`
  Dead,         // no plan from here: proved
  GivenUp,      // no plan was found from here within somebody's budget
};

struct NodeRecord {
  NodeStatus status = NodeStatus::Unknown;
  std::uint32_t depth = 0;
};

class NodeTable {
 public:
  // What is known of the node; Unknown from now on if it was never met.
  NodeRecord& record(const Fingerprint& node);
  std::size_t size() const { return size_; }
  void clear();

 private:
  struct Entry {
    Fingerprint node;
    NodeRecord record;
    bool used = false;
  };

  Entry& find(std::vector<Entry>& entries, const Fingerprint& node) const;

  std::vector<Entry> entries_;  // open addressing; a power of two
  std::size_t size_ = 0;
};

}  // namespace stepwright::htn

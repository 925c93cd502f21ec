#include "supervisor/htn/search/node_table.h"

#include <algorithm>

namespace stepwright::htn {
namespace {

constexpr std::size_t kFirstNodes = 256;

}  // namespace

NodeTable::Entry& NodeTable::find(std::vector<Entry>& entries, const Fingerprint& node) const {
  const std::size_t mask = entries.size() - 1;
  std::size_t at = static_cast<std::size_t>(node.low) & mask;
  while (entries[at].used && !(entries[at].node == node)) at = (at + 1) & mask;
  return entries[at];
}

NodeRecord& NodeTable::record(const Fingerprint& node) {
  if (2 * (size_ + 1) > entries_.size()) {
    std::vector<Entry> larger(std::max(kFirstNodes, 2 * entries_.size()));
    for (const Entry& entry : entries_)
      if (entry.used) find(larger, entry.node) = entry;
    entries_ = std::move(larger);
  }
  Entry& entry = find(entries_, node);
  if (!entry.used) {
    entry.used = true;
    entry.node = node;
    ++size_;
  }
  return entry.record;
}

void NodeTable::clear() {
  entries_.clear();
  size_ = 0;
}

}  // namespace stepwright::htn

#pragma once

// Partial allocations of which no other one with the same choices left is better in time, makespan, travel
// and tardiness at once. One thread at a time.
//
//   if (store.dominated(key, costs)) return;  // else it is in the store now

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace stepwright::fleet::internal {

class DominanceStore {
 public:
  using Costs = std::array<std::int64_t, 4>;

  // Whether a set of costs stored under the key is nowhere worse. If not, these are stored.
  bool dominated(std::uint64_t key, const Costs& costs) {
    if (entries_.size() >= heads_.size()) grow();
    std::uint32_t& head = heads_[slot(key)];
    for (std::uint32_t i = head; i != kEnd; i = entries_[i].next) {
      if (entries_[i].key == key && nowhere_worse(entries_[i].costs, costs)) return true;
    }
    entries_.push_back({key, costs, head});
    head = static_cast<std::uint32_t>(entries_.size() - 1);
    return false;
  }

 private:
  static constexpr std::uint32_t kEnd = 0xffffffff;
  struct Entry {
    std::uint64_t key;
    Costs costs;
    std::uint32_t next;
  };

  static bool nowhere_worse(const Costs& a, const Costs& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] > b[i]) return false;
    }
    return true;
  }
  // The size is a power of two; the product spreads the key over its upper bits.
  std::size_t slot(std::uint64_t key) const {
    return (key * 0x9e3779b97f4a7c15u >> 20) & (heads_.size() - 1);
  }
  void grow() {
    heads_.assign(heads_.empty() ? 1024 : 2 * heads_.size(), kEnd);
    for (std::uint32_t i = 0; i < entries_.size(); ++i) {
      std::uint32_t& head = heads_[slot(entries_[i].key)];
      entries_[i].next = head;
      head = i;
    }
  }

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> heads_;
};

}  // namespace stepwright::fleet::internal

#pragma once

// Numbers for ground atoms and tasks, a head with its objects, in the order of their first use.
//
// Thread rule: a container like any other. Spans are valid until the next `intern`.
//
//   TupleTable table;
//   const int id = table.intern(head, objects);   // 0, then 1, ...

#include <cstddef>
#include <span>
#include <vector>

namespace stepwright::htn {

class TupleTable {
 public:
  // -1 if it has no number.
  int find(int head, std::span<const int> objects) const;
  int intern(int head, std::span<const int> objects);

  std::size_t size() const { return entries_.size(); }
  int head(int id) const { return entries_[static_cast<std::size_t>(id)].head; }
  std::span<const int> objects(int id) const {
    const Entry& entry = entries_[static_cast<std::size_t>(id)];
    return {pool_.data() + entry.begin, entry.size};
  }

 private:
  struct Entry {
    std::size_t begin = 0;
    std::size_t size = 0;
    int head = 0;
  };

  std::size_t place(int head, std::span<const int> objects) const;
  void grow();

  std::vector<int> pool_;
  std::vector<Entry> entries_;
  std::vector<int> places_;  // open addressing: number + 1, 0 = free; a power of two
};

}  // namespace stepwright::htn

#pragma once

// The facts of one predicate as rows of objects, in the order of their arrival, with hash indexes by any of
// their columns.
//
// Thread rule: one grounding, its relations. Invariant: an index, once asked for, follows every row.

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace stepwright::pddl {

class FactRelation {
 public:
  explicit FactRelation(std::size_t columns) : columns_(columns) {}

  std::size_t size() const { return size_; }
  std::span<const int> row(std::size_t i) const { return {cells_.data() + i * columns_, columns_}; }

  // Requires a row that is not there yet.
  void add(std::span<const int> row);

  // The rows that have the objects `key` in the columns of the mask, ascending; the mask must not be empty.
  // Valid until the next add.
  std::span<const int> find(std::uint64_t columns, std::span<const int> key);

  // Columns beyond these have no index; whoever reads a row checks them.
  static constexpr std::size_t kMostIndexed = 64;

 private:
  struct Index {
    std::vector<std::size_t> columns;
    std::unordered_map<std::uint64_t, std::vector<std::vector<int>>> lists;  // by hash; one list per key
  };

  std::vector<int>& list_of(Index& index, std::span<const int> key);
  void add(Index& index, std::size_t row);
  Index& index_of(std::uint64_t columns);

  std::size_t columns_;
  std::size_t size_ = 0;
  std::vector<int> cells_;
  std::unordered_map<std::uint64_t, Index> indexes_;
  std::vector<int> key_;
};

}  // namespace stepwright::pddl

#include "supervisor/pddl/definition/fact_relation.h"

#include "supervisor/pddl/definition/atom_table.h"

namespace stepwright::pddl {

// The list for the key; keys of equal hash are told apart by their first row.
std::vector<int>& FactRelation::list_of(Index& index, std::span<const int> key) {
  auto& lists = index.lists[hash_objects(0, key)];
  for (std::vector<int>& list : lists) {
    const std::span<const int> first = row(static_cast<std::size_t>(list.front()));
    bool same = true;
    for (std::size_t i = 0; i < key.size() && same; ++i) same = first[index.columns[i]] == key[i];
    if (same) return list;
  }
  lists.emplace_back();
  return lists.back();
}

void FactRelation::add(Index& index, std::size_t number) {
  const std::span<const int> cells = row(number);
  key_.clear();
  for (const std::size_t column : index.columns) key_.push_back(cells[column]);
  list_of(index, key_).push_back(static_cast<int>(number));
}

void FactRelation::add(std::span<const int> row) {
  cells_.insert(cells_.end(), row.begin(), row.end());
  ++size_;
  for (auto& [columns, index] : indexes_) add(index, size_ - 1);
}

FactRelation::Index& FactRelation::index_of(std::uint64_t columns) {
  const auto [place, added] = indexes_.try_emplace(columns);
  Index& index = place->second;
  if (!added) return index;
  for (std::size_t column = 0; column < columns_ && column < kMostIndexed; ++column) {
    if ((columns >> column & 1) != 0) index.columns.push_back(column);
  }
  for (std::size_t i = 0; i < size_; ++i) add(index, i);
  return index;
}

std::span<const int> FactRelation::find(std::uint64_t columns, std::span<const int> key) {
  Index& index = index_of(columns);
  const auto found = index.lists.find(hash_objects(0, key));
  if (found == index.lists.end()) return {};
  for (const std::vector<int>& list : found->second) {
    const std::span<const int> first = row(static_cast<std::size_t>(list.front()));
    bool same = true;
    for (std::size_t i = 0; i < key.size() && same; ++i) same = first[index.columns[i]] == key[i];
    if (same) return list;
  }
  return {};
}

}  // namespace stepwright::pddl

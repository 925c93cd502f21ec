#pragma once

// Many short lists in one array, so that walking one touches neighbouring memory only.
//
// Thread rule: a plain value.
//
//   PackedLists<int> lists;
//   lists.append({1, 2});  lists.append({});      for (int i : lists[0]) ...

#include <cstdint>
#include <span>
#include <vector>

namespace stepwright::pddl {

template <typename T>
class PackedLists {
 public:
  PackedLists() = default;
  explicit PackedLists(const std::vector<std::vector<T>>& lists) {
    for (const auto& list : lists) append(list);
  }

  void append(const std::vector<T>& list) {
    items_.insert(items_.end(), list.begin(), list.end());
    ends_.push_back(static_cast<std::uint32_t>(items_.size()));
  }

  std::size_t size() const { return ends_.size(); }
  std::span<const T> operator[](std::size_t list) const {
    const std::uint32_t begin = list == 0 ? 0 : ends_[list - 1];
    return {items_.data() + begin, ends_[list] - begin};
  }

 private:
  std::vector<T> items_;
  std::vector<std::uint32_t> ends_;
};

}  // namespace stepwright::pddl

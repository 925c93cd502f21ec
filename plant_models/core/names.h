#pragma once

// Look-up by name in lists of ports and quantities, and what an error message says about such a list.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/result/closest.h"

namespace stepwright::core {

using naming::same_name;

// The index of the entry with that `name`, or nothing. `List` is a range of things with a `name`.
template <typename List>
std::optional<std::uint32_t> index_of(const List& list, std::string_view name) {
  std::uint32_t index = 0;
  for (const auto& entry : list) {
    if (same_name(entry.name, name)) return index;
    ++index;
  }
  return std::nullopt;
}

template <typename List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& entry : list) names.push_back(entry.name);
  return names;
}

// "a, b, c"
template <typename List>
std::string joined_names(const List& list) {
  std::string text;
  for (const auto& entry : list) {
    if (!text.empty()) text += ", ";
    text += entry.name;
  }
  return text;
}

// "known: a, b, c"; a long list begins with the names that are nearest to `meant`, as messages may be cut:
// "the nearest: b, c; known: a, b, c".
template <typename List>
std::string known_names(const List& list, std::string_view meant, const std::string& known = "known: ") {
  constexpr std::size_t kAll = 12, kNearest = 5;
  std::vector<std::string> left = names_of(list);
  if (left.size() <= kAll) return known + joined_names(list);
  std::string text = "the nearest: ";
  for (std::size_t k = 0; k < kNearest; ++k) {
    const std::string* next = result::closest(meant, left, 256);
    if (next == nullptr) break;
    text += (k == 0 ? "" : ", ") + *next;
    left.erase(left.begin() + (next - left.data()));
  }
  return text + "; " + known + joined_names(list);
}

}  // namespace stepwright::core

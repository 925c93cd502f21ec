#pragma once

// Look-up by name in lists of ports and quantities, and what an error message says about such a list.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/naming/ascii_names.h"

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

}  // namespace stepwright::core

#pragma once

// Question of a reader to its document: one key, with the type, the default and the range that the reader has
// for it. Plain data. A reference that is made of these says what the code does (cell/reference).
//
//   document->listen([&](const AskedKey& asked) { found.push_back(asked); });

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace stepwright::settings {

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// In ascending order of how much is known of the value.
enum class ValueKind : std::uint8_t {
  Presence,  // only whether it is there
  Text,
  Choice,
  Number,
  Integer,
  Boolean,
  Texts,
  Numbers,
  NumberRows,
  Table,
  Tables,
};

struct AskedKey {
  std::string table{};  // dotted, "" for the root; rows of [[plant.vehicles]] have "plant.vehicles"
  std::string key{};
  ValueKind kind = ValueKind::Presence;
  bool required = false;
  std::string fallback{};  // as the file would have it; empty: none, or an empty text
  Range range{};
  std::vector<std::string> choices{};
};

using KeyListener = std::function<void(const AskedKey& asked)>;

// What to say of a key that nobody has asked for: the rest of a hint, or nothing. `table` is dotted.
using KeyAdvice = std::function<std::string(std::string_view table, std::string_view key)>;

}  // namespace stepwright::settings

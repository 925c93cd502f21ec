#pragma once

// A pragma that says of a variable what people want to know beside its value: unit, description, group,
// decimals, range, names of values (hmi_web/doc/tags.md). Keys and values as the standard writes them in
// pragmas (6.2, {x := 256, y := 384}):
//
//   level : REAL; {unit := 'l', decimals := 1, range := 0..200, group := 'buffer'} // how full it is
//   valve : BOOL; {values := ['closed', 'open']}
//
// Texts stand in single quotes: $' is a quote in them, $$ a dollar. Pure; use from any thread.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stepwright::syntax {

struct TagPragma {
  std::string unit;
  std::string description;
  std::string group;
  std::optional<int> decimals;                     // shown behind the point, 0 to 9
  std::optional<std::pair<double, double>> range;  // what is normal: least and greatest value
  std::vector<std::string> values;                 // names of 0, 1, 2, ...

  bool empty() const;
};

struct TagPragmaMistake {
  std::size_t offset = 0;  // into the text between the braces
  std::string message;
  std::string hint;
};

inline constexpr int kMostDecimals = 9;
inline constexpr std::size_t kMostTagText = 200;   // bytes of each text
inline constexpr std::size_t kMostTagValues = 64;  // names of values

// The keys, in the order of the documentation.
std::span<const std::string_view> tag_pragma_keys();

// The first word of a pragma if it is a key of some kind, with ":=" behind it; else empty. `inside`: the text
// between the braces.
std::string_view first_key(std::string_view inside);

// It begins with a key of tags: upper and lower case are alike.
bool is_tag_pragma(std::string_view inside);

// Adds what it says to what is said already, the later word counts. False on a mistake, and nothing is added.
bool read_tag_pragma(std::string_view inside, TagPragma& said, TagPragmaMistake& mistake);

}  // namespace stepwright::syntax

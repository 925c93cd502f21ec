#pragma once

// Place of a key in a JSON text: for messages about values that have been read, whose places the JSON library
// does not keep.
//
// Pure functions; any thread.
//
//   place_of_key(text, "vehicles[2].start.x_m", "night.json")   // night.json:14:22

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::fleet {

// Line and column of a byte of the text, counted from 1.
result::Location place_of_byte(std::string_view text, std::size_t byte, const std::string& file);

// Of the member's name, or of the item of a list. If the key is not there, of the longest part of it that is.
// Requires text that is JSON.
result::Location place_of_key(std::string_view text, std::string_view key, const std::string& file);

struct DoubleMember {
  std::string name;
  result::Location where;  // the second one
};

// The first member whose name its object has twice. Requires text that is JSON.
std::optional<DoubleMember> double_member(std::string_view text, const std::string& file);

}  // namespace stepwright::fleet

#pragma once

// A recipe: a named set of values for tags of a cell's program; and what a cell says of each tag that recipes
// may set.
//
//   Recipe{.name = "Blue 20 l", .values = {{"mixer.level", "20.0"}, {"mixer.stir", "T#90s"}}}
//
// Plain values. Invariant of what recipe_check.h has let pass: each defined tag has exactly one value, within
// its range.

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/bytecode/value_type.h"
#include "runtime/ground/result/result.h"

namespace stepwright::recipes {

inline constexpr std::size_t kMostRecipes = 256;
inline constexpr std::size_t kMostTags = 128;
inline constexpr std::size_t kLongestName = 64;       // of a recipe
inline constexpr std::size_t kLongestTag = 512;       // path or direct address
inline constexpr std::size_t kLongestLiteral = 64;    // of a value
inline constexpr std::size_t kLongestComment = 200;   // bytes
inline constexpr std::size_t kLargestFile = 131'072;  // bytes: more than kMostTags values take

// One tag that recipes set, as the cell's file of definitions has it.
struct RecipeTag {
  std::string name;  // path of a variable, or a direct address
  bytecode::ElementaryType type = bytecode::ElementaryType::Bool;
  double least = 0;  // of numbers; of a TIME in seconds; unused by a BOOL
  double most = 0;
  std::string unit;
  std::string comment;
  result::Location where;         // of its table
  result::Location name_where{};  // of its name

  // Not of the file, but of the program that runs: what the values of an enumeration are called.
  std::shared_ptr<const reader::Enumerators> names = nullptr;
  bool program_unknown = false;  // nobody knows: a word may be such a name
};

// Literals of IEC 61131-3 by the names of tags.
using Values = std::map<std::string, std::string, std::less<>>;

// A BOOL and a text have neither a range nor a unit.
constexpr bool has_range(bytecode::ElementaryType type) {
  return type != bytecode::ElementaryType::Bool && !bytecode::is_string(type);
}

struct Recipe {
  std::string name;
  std::string comment;
  std::string saved_by;
  std::chrono::system_clock::time_point saved;
  Values values;
};

}  // namespace stepwright::recipes

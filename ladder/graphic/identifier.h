#pragma once

// Names of IEC 61131-3: which are legal, when two are the same, and how a program generator finds a free one.
// Pure functions and one value type; use from any thread.
//
//   NameSet names;  names.insert("Pump");
//   names.unique("PUMP")   ->  "PUMP_2"          (names are case-insensitive)
//   names.unique("a.b[1]_X") -> "a_b_1_X"        (made legal first)

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::graphic {

// IEC 61131-3, 6.1.2: a letter or underscore, then letters, digits and single underscores, none at the end.
bool is_identifier(std::string_view text);

// True for keywords of the languages (IF, VAR, BOOL, AND, ...), in any case.
bool is_keyword(std::string_view text);

// Identifiers are case-insensitive.
std::string upper(std::string_view text);
using naming::same_name;

// The nearest legal identifier: other characters become one underscore; never empty.
std::string make_identifier(std::string_view text);

// The names in use in one scope.
class NameSet {
 public:
  // False if the name was in use already.
  bool insert(std::string_view name);
  bool contains(std::string_view name) const;
  // A legal name made from `wanted`, in use by nobody, which is in use from now on.
  std::string unique(std::string_view wanted);

 private:
  std::unordered_set<std::string> used_;          // upper case
  std::unordered_map<std::string, int> numbers_;  // of a name that was wanted: the next to try
};

}  // namespace stepwright::graphic

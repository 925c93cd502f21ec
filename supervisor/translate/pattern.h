#pragma once

// Patterns over ground atoms: "(load ?v ?f ?l)" matches every load, "(move ?v f1 a1)" one trip only. What a
// pattern binds fills in other patterns of the same entry: "(lev ?v)".
//
// Values and pure functions; use from any thread.
//
//   auto bound = match(*parse_pattern("(move ?v ?from ?to)"), {"move", {"v1", "f1", "a1"}});
//   instantiate(*parse_pattern("(is-at ?v ?to)"), *bound)  ->  "(is-at v1 a1)"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "supervisor/model/plan.h"

namespace stepwright::translate {

// Arguments that start with '?' are variables. Names are in lower case.
struct Pattern {
  std::string name;
  std::vector<std::string> arguments;

  friend bool operator==(const Pattern&, const Pattern&) = default;
};

using Assignment = std::map<std::string, std::string>;  // "?v" -> "v1"

bool is_variable(std::string_view argument);
// Nullopt if `text` is not "(name argument ...)".
std::optional<Pattern> parse_pattern(std::string_view text);
std::string to_string(const Pattern& pattern);

// Nullopt if name, number of arguments, a constant or a repeated variable differs.
std::optional<Assignment> match(const Pattern& pattern, const model::GroundAction& action);
// Requires every variable of the pattern to be assigned.
std::string instantiate(const Pattern& pattern, const Assignment& assignment);
// True if every action that `special` matches is matched by `general` too.
bool covers(const Pattern& general, const Pattern& special);

}  // namespace stepwright::translate

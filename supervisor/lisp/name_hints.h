#pragma once

// Hints for misspelt names.
//
// Thread rule: pure functions.

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace stepwright::lisp {

// "did you mean 'distance'?" if one of the candidates is close enough to `name`; empty otherwise, and for
// names longer than anybody writes.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

// The keys of a map of ids: the candidates for a hint.
std::vector<std::string> names_of(const std::map<std::string, int>& ids);

}  // namespace stepwright::lisp

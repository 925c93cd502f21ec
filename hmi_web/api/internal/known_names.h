#pragma once

// Hints for unknown names, of a member of a body or of a parameter: the name that was probably meant. Pure;
// any thread.

#include <cstddef>
#include <string>
#include <vector>

namespace stepwright::api {

// So much of a name from outside is told again.
inline constexpr std::size_t kMostNameBytes = 64;

// "did you mean 'tags'?", or all that are known: "possible: tags, to_ms", or "none".
std::string names_hint(const std::string& name, const std::vector<std::string>& known);

}  // namespace stepwright::api

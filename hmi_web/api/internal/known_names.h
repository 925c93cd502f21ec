#pragma once

// What somebody may have meant who wrote a name that is not known: of a member of a body, of a parameter.

#include <cstddef>
#include <string>
#include <vector>

namespace stepwright::api {

// So much of a name from outside is told again.
inline constexpr std::size_t kMostNameBytes = 64;

// "did you mean 'tags'?", or all that are known: "possible: tags, to_ms", or "none".
std::string names_hint(const std::string& name, const std::vector<std::string>& known);

}  // namespace stepwright::api

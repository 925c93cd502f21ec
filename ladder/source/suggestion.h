#pragma once

// "did you mean": the known name nearest to a misspelt one.

#include <span>
#include <string>
#include <string_view>

namespace stepwright::source {

// "did you mean 'lamp'?", or nothing if no candidate is near (at most a third of the letters differ).
// Case does not count.
std::string did_you_mean(std::string_view wrong, std::span<const std::string_view> candidates);

}  // namespace stepwright::source

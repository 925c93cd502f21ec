#include "ladder/source/suggestion.h"

#include <algorithm>
#include <vector>

#include "ladder/source/name_table.h"
#include "runtime/ground/result/closest.h"

namespace stepwright::source {

std::string did_you_mean(std::string_view wrong, std::span<const std::string_view> candidates) {
  // Nobody misspells a name of that length, and to compare two costs the product of their lengths.
  constexpr std::size_t kLongest = 100;
  if (wrong.size() > kLongest) return {};
  std::vector<std::string_view> names;
  std::vector<std::string> folded;
  for (const std::string_view candidate : candidates) {
    if (candidate.empty() || candidate.size() > 2 * kLongest || candidate.starts_with("__")) continue;
    names.push_back(candidate);
    folded.push_back(upper(candidate));
  }
  const std::size_t most_edits = std::max<std::size_t>(1, wrong.size() / 3);
  const std::string* found = result::closest(upper(wrong), folded, most_edits);
  if (found == nullptr) return {};
  return "did you mean '" + std::string(names[static_cast<std::size_t>(found - folded.data())]) + "'?";
}

}  // namespace stepwright::source

#pragma once

// "did you mean": the known name nearest to a misspelt one. Pure functions; any thread.
//
//   const std::string* meant = closest("lod", names, 1);  // "load", or nullptr

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace stepwright::result {

// The candidate that the fewest edits make from `word`, the first of several; nullptr if all need more than
// `most_edits`. An edit inserts, deletes or replaces a character or swaps two neighbours. Case counts.
const std::string* closest(std::string_view word, std::span<const std::string> candidates,
                           std::size_t most_edits);

}  // namespace stepwright::result

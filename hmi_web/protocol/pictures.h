#pragma once

// The supervisor's pictures of its plan (supervisor/doc/pictures.md) as a viewer gets them, in a message of
// their own: they change with the plan only.
//
//   if (auto message = pictures_message(document)) send(*message);
//
// A pure function; any thread. It trusts nothing in the document.

#include <cstddef>
#include <optional>
#include <string>

namespace stepwright::protocol {

inline constexpr std::size_t kMostPicturesBytes = 800'000;
inline constexpr std::size_t kMostPictures = 8;

// Message `pictures`: of each its `kind` and `id`, which are short texts, and what goes with them, as it
// came; what is nested deeper than any picture is left out. nullopt: the document is too long, no JSON
// object, or without a list.
std::optional<std::string> pictures_message(const std::string& document);

}  // namespace stepwright::protocol

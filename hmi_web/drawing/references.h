#pragma once

// Limit of the references of a drawing: a <use>, a pattern, a clip or a marker that holds others again can
// make a browser draw without an end, from a file of a few lines.
//
//   if (const auto excess = excess_of_references(root)) tell(excess->offset, excess->message, excess->hint);
//
// Pure; any thread.

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace stepwright::drawing {

struct ReferenceExcess {
  std::ptrdiff_t offset = 0;  // in the file
  std::string message;
  std::string hint;
};

// The reference that counts where an element has both: `href` wins over `xlink:href` (SVG 2, 16.1.3). Empty:
// there is none.
std::string_view reference_of(pugi::xml_node element);
// The name without a prefix of the SVG namespace.
std::string_view plain_name(std::string_view name);

// Checks the references below `root`: an error for one that leads back to itself, a <use> of a <use>, more
// than kMostElements elements drawn by all of them together.
std::optional<ReferenceExcess> excess_of_references(pugi::xml_node root);

}  // namespace stepwright::drawing

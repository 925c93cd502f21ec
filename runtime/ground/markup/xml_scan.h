#pragma once

// Begin and end of the parts of an XML text, so that it can be looked through, or changed in place, as it is
// written. Pure; any thread.

#include <cstddef>
#include <string_view>

namespace stepwright::markup {

// What begins at `at` and has no elements (a comment, CDATA, an instruction): where it ends, or `at` if it is
// a tag.
std::size_t end_of_plain(std::string_view xml, std::size_t at);

// Behind the '>' of the tag at `at`: attributes may hold one.
std::size_t end_of_tag(std::string_view xml, std::size_t at);

}  // namespace stepwright::markup

#pragma once

// Where the parts of a well-formed XML text begin and end, so that it can be changed in place and stays the
// same everywhere else. Pure; any thread.

#include <cstddef>
#include <string_view>

namespace stepwright::new_cell {

// What begins at `at` and has no elements (a comment, CDATA, an instruction): where it ends, or `at` if it is
// a tag.
std::size_t end_of_plain(std::string_view xml, std::size_t at);

// Behind the '>' of the tag at `at`: attributes may hold one.
std::size_t end_of_tag(std::string_view xml, std::size_t at);

}  // namespace stepwright::new_cell

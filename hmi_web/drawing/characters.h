#pragma once

// Characters of a drawing: those that XML has (1.0, production 2), as they stand in the file and as
// references. A browser draws no document with any other, in whatever way it is written.
//
//   if (const auto at = place_of_unknown_entity(text)) report(*at, text_of_no_character(text, *at));
//
// Pure; any thread. Texts are UTF-8. Soft breaks count as characters.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace stepwright::drawing {

// Where the first byte of what is no character of a text stands: a control character, U+FFFE, U+FFFF.
std::optional<std::size_t> place_of_control(std::string_view text);
// Where a reference stands to an entity that XML itself does not have (`&b;`, a bare `&`) or to what is no
// character (`&#xD800;`, `&#1;`), outside of comments and CDATA.
std::optional<std::size_t> place_of_unknown_entity(std::string_view text);
// What stands in one of these places, to be told: "&b", "U+0001".
std::string text_of_no_character(std::string_view text, std::size_t at);
// Soft breaks of drawing programs (U+000B of PowerPoint, U+0003 of Illustrator) as line ends.
std::string with_line_ends(std::string text);

}  // namespace stepwright::drawing

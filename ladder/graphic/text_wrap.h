#pragma once

// Text in lines of a bounded width. Pure functions; widths count characters of UTF-8.

#include <cstddef>
#include <string>
#include <vector>

namespace stepwright::graphic {

// Breaks between words, and inside a word that is longer than a line; at least one line.
std::vector<std::string> wrap_words(const std::string& text, std::size_t width);

// Lines of exactly `width` characters but the last: for texts whose blanks matter. At least one line.
std::vector<std::string> wrap_characters(const std::string& text, std::size_t width);

// At most `width` characters, the last one "…" where something is missing.
std::string shortened(const std::string& text, std::size_t width);

}  // namespace stepwright::graphic

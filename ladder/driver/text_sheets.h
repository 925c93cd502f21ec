#pragma once

// The sheets of one ST file. Internal to this folder.

#include <vector>

#include "ladder/graphic/sheet.h"
#include "ladder/syntax/parser.h"

namespace stepwright::driver {

// `unit` holds what `file` declares and nothing else. Reports charts that cannot be drawn.
std::vector<graphic::Sheet> text_sheets(syntax::SyntaxContext& context, source::FileId file,
                                        const syntax::Unit& unit);

// Lines of a text from byte `begin` to `end` without blank lines around them.
graphic::Listing listing_of(std::string_view text, std::size_t begin, std::size_t end);

}  // namespace stepwright::driver

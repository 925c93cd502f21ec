#pragma once

// Prints a program as a control engineer files it: declarations, rungs with numbers, charts, listings and
// cross references; as text for a terminal, or as an SVG of pages with a title block. Pure functions of their
// input without dates: the same program gives the same bytes.
//
//   const std::string svg = print::print_svg(sheets, {.project = "Bench", .paper = print::Paper::A4});
//
// The SVG holds all pages below each other, each a group `<g class="sw-page" data-page="1">`; its size is
// that of the paper, and it asks for pages of that size (@page), so that a browser prints a page on each
// sheet. Nothing is cut off or lost: what is wider than a page is made smaller, rungs go on in another line,
// charts go on over several pages with references "/page.number" at both ends of every line that was cut.

#include <cstdint>
#include <string>
#include <vector>

#include "ladder/graphic/sheet.h"

namespace stepwright::print {

enum class Paper : std::uint8_t { A4, A3 };  // A4 upright, A3 on its side

struct PrintOptions {
  std::string project;  // for the title block
  Paper paper = Paper::A4;
};

// UTF-8 with box characters. Charts must be sound (graphic::check).
std::string print_text(const std::vector<graphic::Sheet>& sheets, const PrintOptions& options);
std::string print_svg(const std::vector<graphic::Sheet>& sheets, const PrintOptions& options);

}  // namespace stepwright::print

#include "ladder/print/sheet_title.h"

#include <algorithm>

namespace stepwright::print {

std::string title_of(const graphic::Sheet& sheet) {
  return sheet.kind + (sheet.name.empty() ? "" : " " + sheet.name) +
         (sheet.result_type.empty() ? "" : " : " + sheet.result_type);
}

bool has_references(const graphic::Sheet& sheet) {
  return sheet.kind == "PROGRAM" || sheet.kind == "FUNCTION_BLOCK" || sheet.kind == "FUNCTION";
}

// What all lines but the first are indented by is the text's place in its file.
graphic::Listing listing_of(const graphic::Action& action) {
  graphic::Listing listing;
  std::string line;
  for (const char c : action.st_body + "\n") {
    if (c == '\n') {
      listing.lines.push_back(std::move(line));
      line.clear();
    } else if (c != '\r') {
      line += c;
    }
  }
  std::size_t indent = std::string::npos;
  for (std::size_t i = 1; i < listing.lines.size(); ++i)
    indent = std::min(indent, listing.lines[i].find_first_not_of(' '));
  for (std::size_t i = 1; i < listing.lines.size() && indent != std::string::npos; ++i)
    listing.lines[i].erase(0, std::min(indent, listing.lines[i].size()));
  while (listing.lines.size() > 1 && listing.lines.back().empty()) listing.lines.pop_back();
  return listing;
}

}  // namespace stepwright::print

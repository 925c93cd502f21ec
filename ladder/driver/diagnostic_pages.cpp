#include "ladder/driver/diagnostic_pages.h"

#include <algorithm>

#include "ladder/source/name_table.h"

namespace stepwright::driver {

std::string_view DiagnosticPage::title() const {
  const std::string_view line = text.substr(0, text.find('\n'));
  const std::size_t colon = line.find(": ");
  return colon == std::string_view::npos ? line : line.substr(colon + 2);
}

const DiagnosticPage* find_page(std::string_view code) {
  const std::string folded = source::upper(code);
  const auto pages = diagnostic_pages();
  const auto found = std::find_if(pages.begin(), pages.end(),
                                  [&](const DiagnosticPage& each) { return each.code == folded; });
  return found == pages.end() ? nullptr : &*found;
}

}  // namespace stepwright::driver

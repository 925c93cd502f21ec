#include "runtime/ground/markup/xml_scan.h"

namespace stepwright::markup {

std::size_t end_of_plain(std::string_view xml, std::size_t at) {
  constexpr std::string_view kPlain[][2] = {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};
  for (const auto& [open, close] : kPlain) {
    if (!xml.substr(at).starts_with(open)) continue;
    const std::size_t end = xml.find(close, at + open.size());
    return end == std::string_view::npos ? xml.size() : end + close.size();
  }
  return at;
}

std::size_t end_of_tag(std::string_view xml, std::size_t at) {
  char quote = 0;
  for (; at < xml.size(); ++at) {
    const char c = xml[at];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return at + 1;
    }
  }
  return at;
}

}  // namespace stepwright::markup

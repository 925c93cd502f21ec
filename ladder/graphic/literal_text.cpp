#include "ladder/graphic/literal_text.h"

#include <fmt/format.h>

namespace stepwright::graphic {
namespace {

std::string with_point(std::string text) {
  if (text == "-0") text = "0";
  const std::size_t exponent = text.find('e');
  if (text.find('.') == std::string::npos)
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".0");
  return text;
}

}  // namespace

std::string real_literal(double value) {
  return with_point(fmt::format("{}", value));
}

std::string real_literal(double value, int digits) {
  return with_point(fmt::format("{:.{}g}", value, digits));
}

}  // namespace stepwright::graphic

#include "supervisor/vehicle/literals.h"

#include <fmt/format.h>

namespace stepwright::vehicle {

std::string real_literal(double value) {
  std::string text = fmt::format("{:.7g}", value);
  if (text == "-0") text = "0";
  const std::size_t exponent = text.find('e');
  if (text.find('.') == std::string::npos)
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".0");
  return text;
}

std::string time_literal(std::chrono::milliseconds time) {
  return time.count() % 1'000 == 0 ? fmt::format("T#{}s", time.count() / 1'000)
                                   : fmt::format("T#{}ms", time.count());
}

std::string member(const char* name, double value) {
  return fmt::format("{} := {}", name, real_literal(value));
}

}  // namespace stepwright::vehicle

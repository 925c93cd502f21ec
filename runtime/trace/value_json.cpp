#include "runtime/trace/value_json.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace stepwright::trace {

nlohmann::json to_json(const reader::Value& value) {
  if (const double* number = std::get_if<double>(&value); number != nullptr && !std::isfinite(*number)) {
    return std::isnan(*number) ? "NaN" : *number > 0 ? "Infinity" : "-Infinity";
  }
  return std::visit([](const auto& plain) { return nlohmann::json(plain); }, value);
}

std::string hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(value));
  return text;
}

}  // namespace stepwright::trace

#include "hmi_web/protocol/json_text.h"

#include <cmath>

namespace stepwright::protocol {

nlohmann::json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  // Beyond 2^53 a double holds no fraction, and the product could overflow.
  constexpr double kExact = 9007199254740992.0;
  const double thousandths = std::abs(value) < kExact / 1000 ? std::round(value * 1000) / 1000 : value;
  if (thousandths == std::floor(thousandths) && std::abs(thousandths) < kExact) {
    return static_cast<std::int64_t>(thousandths);
  }
  return thousandths;
}

nlohmann::json number(const std::optional<double>& value) {
  return value ? number(*value) : nlohmann::json(nullptr);
}

nlohmann::json numbers(const std::vector<std::optional<double>>& values) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& value : values) list.push_back(number(value));
  return list;
}

std::string text(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace stepwright::protocol

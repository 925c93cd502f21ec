#include "hmi_web/protocol/json_text.h"

#include <array>
#include <charconv>
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

std::string number_text(const std::optional<double>& value) {
  const nlohmann::json rounded = number(value);
  if (rounded.is_null()) return "null";
  std::array<char, 32> room{};
  char* const end = room.data() + room.size();
  const auto written = rounded.is_number_integer()
                           ? std::to_chars(room.data(), end, rounded.get<std::int64_t>())
                           : std::to_chars(room.data(), end, rounded.get<double>());
  return {room.data(), written.ptr};
}

std::string exact_number_text(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return "null";
  std::array<char, 32> room{};
  return {room.data(), std::to_chars(room.data(), room.data() + room.size(), *value).ptr};
}

std::string text(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace stepwright::protocol

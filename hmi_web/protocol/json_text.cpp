#include "hmi_web/protocol/json_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace stepwright::protocol {

namespace {

// Beyond 2^53 a double holds no fraction, and a product with it could overflow.
constexpr double kExact = 9007199254740992.0;

bool is_whole(double value) {
  return value == std::floor(value) && std::abs(value) < kExact;
}

double with_three_decimals(double value) {
  return std::abs(value) < kExact / 1000 ? std::round(value * 1000) / 1000 : value;
}

double with_six_digits(double value) {
  constexpr double kThreeDecimals = 100;  // are six digits and more from here on
  if (std::abs(value) >= kThreeDecimals) return with_three_decimals(value);
  std::array<char, 32> room{};
  const auto written =
      std::to_chars(room.data(), room.data() + room.size(), value, std::chars_format::general, 6);
  double rounded = 0;
  std::from_chars(room.data(), written.ptr, rounded);
  return rounded;
}

nlohmann::json number_of(double value) {
  if (is_whole(value)) return static_cast<std::int64_t>(value);
  return value;
}

template <typename Number>
std::string shortest(Number value) {
  std::array<char, 32> room{};
  return {room.data(), std::to_chars(room.data(), room.data() + room.size(), value).ptr};
}

std::string text_of(double value, bool is_real) {
  if (is_whole(value)) return shortest(static_cast<std::int64_t>(value));
  return is_real ? shortest(static_cast<float>(value)) : shortest(value);
}

}  // namespace

nlohmann::json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return number_of(with_three_decimals(value));
}

nlohmann::json measured(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return nullptr;
  return number_of(with_six_digits(*value));
}

nlohmann::json measured(const std::vector<std::optional<double>>& values) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& value : values) list.push_back(measured(value));
  return list;
}

std::string measured_text(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return "null";
  return text_of(with_six_digits(*value), false);
}

std::string value_text(const std::optional<double>& value, bool is_real) {
  if (!value || !std::isfinite(*value)) return "null";
  return text_of(*value, is_real);
}

nlohmann::json value_json(const std::optional<double>& value, bool is_real) {
  return nlohmann::json::parse(value_text(value, is_real));
}

std::string text(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace stepwright::protocol

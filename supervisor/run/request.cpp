#include "supervisor/run/request.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace stepwright::run {
namespace {

using nlohmann::json;

constexpr const char* kNoRequest = "this is no operator request";

Request::Value rows_of(const json& value) {
  Request::Rows rows;
  for (const json& row : value) {
    if (!row.is_array()) return {};
    std::vector<double>& numbers = rows.emplace_back();
    for (const json& number : row) {
      if (!number.is_number()) return {};
      numbers.push_back(number.get<double>());
    }
  }
  return rows;
}

Request::Value value_of(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  if (value.is_number()) return value.get<double>();
  if (value.is_array()) return rows_of(value);
  return {};
}

// What of `values` is of this type.
template <typename Type, typename Values>
std::optional<Type> find(const Values& values, std::string_view key) {
  const auto found = values.find(key);
  if (found == values.end()) return std::nullopt;
  const Type* value = std::get_if<Type>(&found->second);
  return value == nullptr ? std::nullopt : std::optional<Type>(*value);
}

}  // namespace

result::Result<Request> Request::parse(const std::string& text) {
  const auto document = json::parse(text, nullptr, /*allow_exceptions=*/false);
  Request request;
  if (document.is_object()) {
    for (const auto& [key, value] : document.items()) request.values_[key] = value_of(value);
  }
  auto word = request.text("request");
  if (!word) return result::fail("X0005", {}, kNoRequest, R"_(for example {"request": "abort"})_");
  request.word_ = *std::move(word);
  return request;
}

std::optional<std::string> Request::text(std::string_view key) const {
  return find<std::string>(values_, key);
}

std::optional<double> Request::number(std::string_view key) const {
  if (const auto whole = find<std::uint64_t>(values_, key)) return static_cast<double>(*whole);
  return find<double>(values_, key);
}

std::optional<Request::Rows> Request::rows(std::string_view key, std::size_t width, std::size_t most) const {
  auto rows = find<Rows>(values_, key);
  if (!rows || rows->size() > most) return std::nullopt;
  for (const std::vector<double>& row : *rows) {
    if (row.size() != width) return std::nullopt;
  }
  return rows;
}

std::optional<std::string> Request::text_or(std::string_view key, const char* fallback) const {
  return values_.contains(key) ? text(key) : std::optional<std::string>(fallback);
}

std::optional<std::uint64_t> Request::count_or(std::string_view key, std::uint64_t fallback,
                                               std::uint64_t most) const {
  if (!values_.contains(key)) return fallback;
  const auto count = find<std::uint64_t>(values_, key);
  return count && *count <= most ? count : std::nullopt;
}

result::Result<void> no_request(const char* hint) {
  return result::fail("X0005", {}, kNoRequest, hint);
}

result::Result<void> not_of_this_mission(const char* hint) {
  return result::fail("X0003", {}, "this cell does not take such requests", hint);
}

}  // namespace stepwright::run

#include "hmi_web/api/route_table.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

namespace stepwright::api {
namespace {

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(at);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::optional<int> digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return std::nullopt;
}

// nullopt for a percent sign that is followed by no two digits, and for a zero byte.
std::optional<std::string> decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      result += text[i];
      continue;
    }
    const auto high = i + 2 < text.size() ? digit(text[i + 1]) : std::nullopt;
    const auto low = i + 2 < text.size() ? digit(text[i + 2]) : std::nullopt;
    if (!high || !low || (*high == 0 && *low == 0)) return std::nullopt;
    result += static_cast<char>(*high * 16 + *low);
    i += 2;
  }
  return result;
}

bool is_variable(std::string_view part) {
  return part.size() > 2 && part.front() == '{' && part.back() == '}';
}

std::optional<Match> match_path(const Route& row, const std::vector<std::string_view>& parts) {
  const auto pattern = split(row.path, '/');
  if (pattern.size() != parts.size()) return std::nullopt;
  Match match{&row};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!is_variable(pattern[i])) {
      if (pattern[i] != parts[i]) return std::nullopt;
      continue;
    }
    auto value = decoded(parts[i]);
    if (!value || value->empty()) return std::nullopt;
    match.parameters.emplace(pattern[i].substr(1, pattern[i].size() - 2), std::move(*value));
  }
  return match;
}

void take_query(Match& match, std::string_view query) {
  for (const std::string_view part : split(query, '&')) {
    const std::size_t equals = std::min(part.find('='), part.size());
    const auto name = decoded(part.substr(0, equals));
    auto value = decoded(part.substr(std::min(equals + 1, part.size())));
    if (!name || !value) {
      match.readable = false;
      continue;
    }
    const auto& known = match.route->query;
    if (std::any_of(known.begin(), known.end(), [&](const Parameter& each) { return each.name == *name; }))
      match.parameters.emplace(*name, std::move(*value));
    else if (match.unknown.empty())
      match.unknown = *name;
  }
}

// "/api/users/{name}" and "/api/users/{id}" are the same.
[[maybe_unused]] std::string shape_of(const Route& row) {
  std::string shape = row.method;
  for (const std::string_view part : split(row.path, '/'))
    shape += "/" + std::string(is_variable(part) ? "{}" : part);
  return shape;
}

}  // namespace

RouteTable::RouteTable(std::vector<Route> rows) : rows_(std::move(rows)) {
  // Fixed parts win over variable ones.
  std::stable_sort(rows_.begin(), rows_.end(), [](const Route& a, const Route& b) {
    return std::count(a.path.begin(), a.path.end(), '{') < std::count(b.path.begin(), b.path.end(), '{');
  });
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) assert(shape_of(rows_[i]) != shape_of(rows_[j]));
  }
}

Match RouteTable::find(std::string_view method, std::string_view target) const {
  const std::size_t question = std::min(target.find('?'), target.size());
  const auto parts = split(target.substr(0, question), '/');
  const std::string_view asked = method == "HEAD" ? "GET" : method;
  Match none;
  for (const Route& row : rows_) {
    auto match = match_path(row, parts);
    if (!match) continue;
    if (row.method == asked) {
      take_query(*match, target.substr(std::min(question + 1, target.size())));
      return *std::move(match);
    }
    none.allowed += (none.allowed.empty() ? "" : ", ") + row.method;
  }
  return none;
}

}  // namespace stepwright::api

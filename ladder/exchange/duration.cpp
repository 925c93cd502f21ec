#include "ladder/exchange/duration.h"

#include <array>
#include <cctype>
#include <cstdlib>
#include <utility>

#include "ladder/graphic/identifier.h"

namespace stepwright::exchange {
namespace {

std::optional<std::int64_t> unit_ns(const std::string& name) {
  constexpr std::array<std::pair<const char*, std::int64_t>, 7> units{{{"D", 86'400'000'000'000},
                                                                       {"H", 3'600'000'000'000},
                                                                       {"M", 60'000'000'000},
                                                                       {"S", 1'000'000'000},
                                                                       {"MS", 1'000'000},
                                                                       {"US", 1'000},
                                                                       {"NS", 1}}};
  for (const auto& [unit, ns] : units)
    if (name == unit) return ns;
  return std::nullopt;
}

}  // namespace

std::optional<std::int64_t> duration_us(const std::string& text) {
  std::string rest = graphic::upper(text);
  for (const char* prefix : {"LTIME#", "TIME#", "LT#", "T#"}) {
    const std::string start(prefix);
    if (rest.rfind(start, 0) != 0) continue;
    rest.erase(0, start.size());
    break;
  }
  double ns = 0;
  std::size_t at = 0;
  while (at < rest.size()) {
    if (rest[at] == '_') {
      ++at;
      continue;
    }
    std::string number;
    while (at < rest.size() && (std::isdigit(static_cast<unsigned char>(rest[at])) != 0 || rest[at] == '.'))
      number += rest[at++];
    std::string unit;
    while (at < rest.size() && std::isalpha(static_cast<unsigned char>(rest[at])) != 0) unit += rest[at++];
    const std::optional<std::int64_t> scale = unit_ns(unit);
    if (number.empty() || !scale) return std::nullopt;
    ns += std::strtod(number.c_str(), nullptr) * static_cast<double>(*scale);
  }
  const double us = ns / 1000;
  const auto whole = static_cast<std::int64_t>(us + 0.5);
  if (rest.empty() || us > 1e15 || us - static_cast<double>(whole) > 1e-6 ||
      static_cast<double>(whole) - us > 1e-6)
    return std::nullopt;
  return whole;
}

std::optional<std::int64_t> clock_duration_us(const std::string& text) {
  std::string plain;
  std::string units = "HM";
  for (const char c : text) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.';
    if (!digit && (c != ':' || units.empty())) return std::nullopt;
    plain += digit ? c : units.front();
    if (!digit) units.erase(0, 1);
  }
  return units.empty() ? duration_us(plain + "S") : std::nullopt;
}

std::optional<std::int64_t> xsd_duration_us(const std::string& text) {
  if (text.size() < 3 || text[0] != 'P') return std::nullopt;
  // Behind T the units are those of the language; an M before it would be a month.
  std::string units = "DT";
  std::string plain;
  for (const char c : text.substr(1)) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.';
    const std::size_t unit = units.find(c);
    if (!digit && unit == std::string::npos) return std::nullopt;
    if (!digit) units = c == 'T' ? "HMS" : units.substr(unit + 1);
    if (c != 'T') plain += c;
  }
  return duration_us(plain);
}

}  // namespace stepwright::exchange

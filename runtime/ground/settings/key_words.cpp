#include "runtime/ground/settings/key_words.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace stepwright::settings {
namespace {

using Ending = std::pair<std::string_view, std::string_view>;

// The first that fits: longer ones stand before their own ends.
constexpr std::array kEndings = {
    Ending{"_s2_m2", "s²/m²"}, Ending{"_m_s2", "m/s²"},   Ending{"_rad_s2", "rad/s²"},
    Ending{"_n_m", "N/m"},     Ending{"_1_s", "1/s"},     Ending{"_rad_s", "rad/s"},
    Ending{"_m_s", "m/s"},     Ending{"_kgm2", "kg m²"},  Ending{"_us", "µs"},
    Ending{"_ms", "ms"},       Ending{"_minutes", "min"}, Ending{"_hours", "h"},
    Ending{"_per_s", "1/s"},   Ending{"_mb", "MB"},       Ending{"_bytes", "bytes"},
    Ending{"_rad", "rad"},     Ending{"_deg", "degrees"}, Ending{"_kg", "kg"},
    Ending{"_n", "N"},         Ending{"_m", "m"},         Ending{"_s", "s"},
};

constexpr std::size_t kMostTables = 3;  // a key that more tables have tells nobody where it belongs

}  // namespace

std::string_view unit_of(std::string_view key) {
  const auto found =
      std::ranges::find_if(kEndings, [&](const Ending& ending) { return key.ends_with(ending.first); });
  return found == kEndings.end() ? std::string_view() : found->second;
}

std::string advice_of(std::span<const KeyWords> words, std::string_view table, std::string_view key) {
  const std::string whole = table.empty() ? std::string(key) : std::string(table) + "." + std::string(key);
  std::vector<std::string> tables;
  for (const KeyWords& each : words) {
    if (each.key == whole)
      return "[" + std::string(table) + "] has this key, but not with what else it says here";
    const std::size_t dot = each.key.rfind('.');
    const std::string_view last = dot == std::string_view::npos ? each.key : each.key.substr(dot + 1);
    if (last == key && dot != std::string_view::npos) tables.emplace_back(each.key.substr(0, dot));
  }
  if (tables.empty() || tables.size() > kMostTables) return {};
  std::string named;
  for (const std::string& each : tables) named += (named.empty() ? "[" : ", [") + each + "]";
  return "'" + std::string(key) + "' is a key of " + named;
}

}  // namespace stepwright::settings

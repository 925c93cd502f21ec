#include "hmi_web/access/audit_text.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <nlohmann/json.hpp>

namespace stepwright::access {
namespace {

using nlohmann::json;

constexpr std::array kColumns = {"seq",    "time",   "user",  "role",   "address", "action",
                                 "target", "before", "after", "reason", "result",  "hash"};

std::string cell(const json& entry, const char* column) {
  const auto found = entry.find(column);
  if (found == entry.end()) return {};
  if (!found->is_string()) return found->dump();
  std::string text = found->get<std::string>();
  if (!text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos)
    text.insert(text.begin(), '\'');
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string newest_entries(std::string_view text, std::size_t most, std::uint64_t before) {
  json list = json::array();
  while (!text.empty() && list.size() < most) {
    if (text.back() == '\n') text.remove_suffix(1);
    const std::size_t start = text.rfind('\n');
    const std::string_view line = start == std::string_view::npos ? text : text.substr(start + 1);
    json entry = json::parse(line, nullptr, /*allow_exceptions=*/false);
    text = start == std::string_view::npos ? std::string_view() : text.substr(0, start + 1);
    if (!entry.is_object() || !entry.contains("seq") || !entry["seq"].is_number_unsigned()) continue;
    if (before == 0 || entry["seq"].get<std::uint64_t>() < before) list.push_back(std::move(entry));
  }
  return list.dump();
}

std::string entries_csv(std::string_view text) {
  std::string table;
  for (const char* column : kColumns) table += (table.empty() ? "" : ",") + std::string(column);
  table += "\r\n";
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const json entry = json::parse(text.substr(0, end), nullptr, /*allow_exceptions=*/false);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!entry.is_object()) continue;
    for (const char* column : kColumns) table += (column == kColumns[0] ? "" : ",") + cell(entry, column);
    table += "\r\n";
  }
  return table;
}

std::string utc_text(std::int64_t ms_since_1970) {
  // Far beyond any calendar a time would not be printed.
  const std::int64_t ms = std::clamp<std::int64_t>(ms_since_1970, 0, 253'402'300'799'999);
  return fmt::format("{:%FT%T}.{:03}Z", fmt::gmtime(static_cast<std::time_t>(ms / 1'000)), ms % 1'000);
}

}  // namespace stepwright::access

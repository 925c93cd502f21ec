#include "ladder/syntax/number.h"

#include <array>
#include <charconv>
#include <limits>
#include <string>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::syntax {

namespace {

int digit_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return 99;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Underscores stand between digits, one at a time (6.3.1).
bool has_sound_underscores(std::string_view text) {
  for (std::size_t at = text.find('_'); at != std::string_view::npos; at = text.find('_', at + 1))
    if (at == 0 || at + 1 == text.size() || !is_digit(text[at - 1]) || !is_digit(text[at + 1])) return false;
  return true;
}

struct Unit {
  std::string_view name;
  std::uint64_t ns;
};

// Longer names before their prefixes.
constexpr std::array<Unit, 7> kUnits = {{{"ms", 1'000'000},
                                         {"us", 1'000},
                                         {"ns", 1},
                                         {"d", 86'400'000'000'000},
                                         {"h", 3'600'000'000'000},
                                         {"m", 60'000'000'000},
                                         {"s", 1'000'000'000}}};

const Unit* take_unit(std::string_view& text) {
  for (const Unit& unit : kUnits) {
    if (text.size() < unit.name.size()) continue;
    bool equal = true;
    for (std::size_t i = 0; i < unit.name.size(); ++i)
      equal = equal && naming::to_lower(text[i]) == unit.name[i];
    if (!equal) continue;
    text.remove_prefix(unit.name.size());
    return &unit;
  }
  return nullptr;
}

std::string_view take_digits(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && (is_digit(text[end]) || text[end] == '_')) ++end;
  const std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  return digits;
}

using Wide = unsigned __int128;
constexpr Wide kLimit = static_cast<Wide>(std::numeric_limits<std::int64_t>::max());

// "123.45" of `unit` in nanoseconds, cut off below one.
std::optional<Wide> part_ns(std::string_view whole, std::string_view fraction, std::uint64_t unit) {
  const auto integer = parse_integer(whole, 10);
  if (!integer) return std::nullopt;
  Wide ns = static_cast<Wide>(*integer) * unit;
  Wide scale = unit;
  for (const char c : fraction) {
    if (c == '_') continue;
    ns += static_cast<Wide>(digit_value(c)) * scale / 10;
    scale /= 10;
  }
  return ns <= kLimit ? std::optional(ns) : std::nullopt;
}

}  // namespace

std::optional<std::uint64_t> parse_integer(std::string_view digits, unsigned base) {
  if (digits.empty() || digits.front() == '_' || digits.back() == '_') return std::nullopt;
  std::uint64_t value = 0;
  char before = '0';
  for (const char c : digits) {
    if (c == '_' && before == '_') return std::nullopt;
    before = c;
    if (c == '_') continue;
    const auto digit = static_cast<unsigned>(digit_value(c));
    if (digit >= base) return std::nullopt;
    if (value > (std::numeric_limits<std::uint64_t>::max() - digit) / base) return std::nullopt;
    value = value * base + digit;
  }
  return value;
}

std::optional<double> parse_real(std::string_view text) {
  if (!has_sound_underscores(text)) return std::nullopt;
  std::string plain;
  for (const char c : text)
    if (c != '_') plain += c;
  double value = 0;
  const auto [end, status] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (status != std::errc() || end != plain.data() + plain.size()) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_duration(std::string_view text) {
  bool negative = false;
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    negative = text.front() == '-';
    text.remove_prefix(1);
  }
  Wide total = 0;
  std::uint64_t last_unit = std::numeric_limits<std::uint64_t>::max();
  if (text.empty()) return std::nullopt;
  while (!text.empty()) {
    const std::string_view whole = take_digits(text);
    std::string_view fraction;
    if (!text.empty() && text.front() == '.') {
      text.remove_prefix(1);
      fraction = take_digits(text);
      if (fraction.empty() || !has_sound_underscores(fraction)) return std::nullopt;
    }
    const Unit* unit = take_unit(text);
    if (unit == nullptr || unit->ns >= last_unit || (!fraction.empty() && !text.empty())) return std::nullopt;
    last_unit = unit->ns;
    const auto part = part_ns(whole, fraction, unit->ns);
    if (!part) return std::nullopt;
    total += *part;
    if (total > kLimit) return std::nullopt;
    if (text.empty() || text.front() != '_') continue;
    text.remove_prefix(1);
    if (text.empty()) return std::nullopt;
  }
  const auto value = static_cast<std::int64_t>(total);
  return negative ? -value : value;
}

}  // namespace stepwright::syntax

#include "supervisor/ltl/syntax/duration.h"

#include <array>
#include <charconv>
#include <cmath>

namespace stepwright::ltl {

namespace {

struct Unit {
  std::string_view name;
  double ns;
};
// From the largest to the smallest, as they stand in a duration.
constexpr std::array<Unit, 5> kUnits = {
    {{"d", 86'400e9}, {"h", 3'600e9}, {"m", 60e9}, {"s", 1e9}, {"ms", 1e6}}};
constexpr double kLeastNs = 1e6, kMostNs = 3'600'000e9;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::optional<std::int64_t> duration_ns(std::string_view text) {
  if (text.size() < 3) return std::nullopt;
  text.remove_prefix(2);
  double sum_ns = 0.0;
  std::size_t next_unit = 0;
  while (!text.empty()) {
    double amount = 0.0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), amount, std::chars_format::fixed);
    if (error != std::errc() || !is_digit(text.front())) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    std::size_t letters = 0;
    while (letters < text.size() && !is_digit(text[letters])) ++letters;
    while (next_unit < kUnits.size() && kUnits[next_unit].name != text.substr(0, letters)) ++next_unit;
    if (next_unit == kUnits.size()) return std::nullopt;
    sum_ns += amount * kUnits[next_unit++].ns;
    text.remove_prefix(letters);
  }
  if (!(sum_ns >= kLeastNs && sum_ns <= kMostNs)) return std::nullopt;
  return std::llround(sum_ns / kLeastNs) * static_cast<std::int64_t>(kLeastNs);
}

}  // namespace stepwright::ltl

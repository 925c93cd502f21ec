#include "hmi_web/server/value_texts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "hmi_web/tags/known_tags.h"
#include "runtime/base/time_text.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::server {
namespace {

using bytecode::ElementaryType;
using naming::upper;

constexpr double kMinute = 60;
constexpr double kHour = 3'600;
constexpr double kDay = 86'400;

// The fewest digits that mean this number.
template <typename Real>
std::string shortest(Real value) {
  std::array<char, 32> room{};
  return {room.data(), std::to_chars(room.data(), room.data() + room.size(), value + Real{0}).ptr};
}

std::string fixed(double value, int decimals) {
  std::array<char, 400> room{};
  std::string text(
      room.data(),
      std::to_chars(room.data(), room.data() + room.size(), value, std::chars_format::fixed, decimals).ptr);
  const bool is_zero = text.find_first_of("123456789") == std::string::npos;
  return is_zero && text.starts_with('-') ? text.substr(1) : text;
}

// "4", "1.50", "12.3", "128".
std::string digits_in(double ns, double unit) {
  const double value = ns / unit;
  return fixed(value, value == std::floor(value) || value >= 100 ? 0 : value >= 10 ? 1 : 2);
}

// "2 h 5 min": the whole of the greater unit, and what is left in the smaller one.
std::string two_units(double seconds, double unit, const char* name, double part, const char* part_name) {
  const auto parts = static_cast<std::int64_t>(std::floor(seconds / part));
  const auto per_unit = static_cast<std::int64_t>(std::llround(unit / part));
  const std::string whole = std::to_string(parts / per_unit) + " " + name;
  const std::int64_t rest = parts % per_unit;
  return rest == 0 ? whole : whole + " " + std::to_string(rest) + " " + part_name;
}

std::string size_text(double seconds) {
  const double ns = std::round(seconds * 1e9);
  if (ns == 0) return "0 s";
  if (ns < 999.5) return digits_in(ns, 1) + " ns";
  if (ns < 999.5e3) return digits_in(ns, 1e3) + " us";
  if (ns < 999.5e6) return digits_in(ns, 1e6) + " ms";
  if (ns < 59.95e9) return digits_in(ns, 1e9) + " s";
  const double told = std::max(ns / 1e9, kMinute);
  if (told < kHour) return two_units(told, kMinute, "min", 1, "s");
  return told < kDay ? two_units(told, kHour, "h", kMinute, "min") : two_units(told, kDay, "d", kHour, "h");
}

// As people write it. A double does not count the nanoseconds of a date of today.
std::string date_text(ElementaryType type, double value) {
  if (!std::isfinite(value) || std::abs(value) > 9.2e18) return shortest(value);
  constexpr std::int64_t kMicrosecond = 1'000;
  const std::int64_t ns = std::llround(value / kMicrosecond) * kMicrosecond;
  const base::ShortText text = type == ElementaryType::Date  ? base::text_of_date(ns)
                               : type == ElementaryType::Tod ? base::text_of_time_of_day(ns)
                                                             : base::text_of_date_and_time(ns);
  const auto characters = text.view();
  return {characters.begin(), characters.end()};
}

// LINT, ULINT and LWORD are kept as doubles, which do not have all their digits beyond 2^53.
bool is_rounded(std::optional<ElementaryType> type, double value) {
  constexpr double kLastExact = 9007199254740992.0;
  return std::abs(value) > kLastExact && std::isfinite(value) &&
         (type == ElementaryType::Lint || type == ElementaryType::Ulint || type == ElementaryType::Lword);
}

// With 15 digits: "≈ 18446744073709600000".
std::string rounded_text(double value) {
  constexpr int kDigits = 15;
  std::array<char, 32> room{};
  const std::string text(room.data(), std::to_chars(room.data(), room.data() + room.size(), std::abs(value),
                                                    std::chars_format::scientific, kDigits - 1)
                                          .ptr);
  const std::size_t power_at = text.find('e');
  const int power = std::atoi(text.c_str() + power_at + 1);
  std::string digits = text.substr(0, 1) + text.substr(2, power_at - 2);
  digits.append(static_cast<std::size_t>(std::max(0, power + 1 - kDigits)), '0');
  return std::string("≈ ") + (value < 0 ? "-" : "") + digits;
}

bool is_date(std::optional<ElementaryType> type) {
  return type == ElementaryType::Date || type == ElementaryType::Tod || type == ElementaryType::Dt;
}

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
}

}  // namespace

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return shortest(seconds);
  const std::string size = size_text(std::abs(seconds));
  return seconds < 0 && size != "0 s" ? "-" + size : size;
}

void ValueTexts::Known::add(const protocol::TagNote& note) {
  if (unit.empty()) unit = note.unit;
  if (!decimals) decimals = note.decimals;
  if (values.empty()) values = note.values;
}

std::optional<std::string> ValueTexts::Known::name_of(double value) const {
  if (value != std::floor(value) || std::abs(value) > 1e15) return std::nullopt;
  const auto number = static_cast<std::int64_t>(value);
  if (number >= 0 && static_cast<std::size_t>(number) < values.size())
    return values[static_cast<std::size_t>(number)];
  if (enumeration == nullptr) return std::nullopt;
  const auto found = enumeration->find(number);
  return found == enumeration->end() ? std::nullopt : std::optional(found->second);
}

std::string ValueTexts::Known::digits_of(double value) const {
  if (decimals) return fixed(value, *decimals);
  return type == ElementaryType::Real ? shortest(static_cast<float>(value)) : shortest(value);
}

ValueTexts::ValueTexts(std::vector<protocol::TagNote> notes, const std::vector<protocol::Point>& points,
                       const ProgramLayout* layout)
    : notes_(std::move(notes)), layout_(layout) {
  for (std::size_t i = 0; i < notes_.size(); ++i) by_name_.emplace(upper(notes_[i].name), i);
  for (const protocol::Point& point : points) points_.emplace(point.id, point.unit);
}

const protocol::TagNote* ValueTexts::note_of(const std::string& folded) const {
  const auto found = by_name_.find(folded);
  return found == by_name_.end() ? nullptr : &notes_[found->second];
}

ValueTexts::Known ValueTexts::known(std::string_view name) const {
  Known known;
  std::string whole(name);
  const auto point = points_.find(whole);
  const auto tag =
      point == points_.end() && layout_ != nullptr ? find_tag_index(*layout_, name) : std::nullopt;
  if (tag) whole = layout_->program.tags[*tag].name;
  const protocol::TagNote* note = note_of(upper(whole));
  if (note == nullptr) note = note_of(upper(tags::without_indices(whole)));
  if (note != nullptr) known.add(*note);
  if (point != points_.end() && known.unit.empty()) known.unit = point->second;
  if (!tag) return known;
  const protocol::ProgramTag& said = layout_->program.tags[*tag];
  known.add(said.note);
  known.type = layout_->tags[*tag].type;
  if (said.enumeration && *said.enumeration < layout_->program.enumerations.size())
    known.enumeration = &layout_->program.enumerations[*said.enumeration];
  return known;
}

ValueText ValueTexts::of(const std::string& name, double value) {
  auto found = found_.find(name);
  if (found == found_.end()) found = found_.emplace(name, this->known(name)).first;
  const Known& known = found->second;
  const bool is_bool = known.type == ElementaryType::Bool;
  if (const auto named = known.name_of(value)) return {*named, "", is_bool};
  if (is_bool) return {value != 0 ? "TRUE" : "FALSE", "", true};
  // A time has its own unit, whatever somebody says of it.
  if (known.type == ElementaryType::Time) return {duration_text(value), "s"};
  if (is_rounded(known.type, value)) return {with_unit(rounded_text(value), known.unit), known.unit};
  if (is_date(known.type)) return {date_text(*known.type, value), ""};
  return {with_unit(known.digits_of(value), known.unit), known.unit};
}

}  // namespace stepwright::server

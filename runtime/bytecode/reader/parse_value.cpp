#include "runtime/bytecode/reader/parse_value.h"

#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include "runtime/base/number_text.h"
#include "runtime/base/time_text.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::reader {
namespace {

using bytecode::ElementaryType;

// Without the name of its own type in front ("INT#5").
std::string_view without_type(ElementaryType type, std::string_view text) {
  const std::size_t hash = text.find('#');
  const bool typed =
      hash != std::string_view::npos && naming::same_name(text.substr(0, hash), bytecode::name_of(type));
  return typed ? text.substr(hash + 1) : text;
}

template <typename T>
std::uint64_t bits_of(T value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof value);
  return bits;
}

template <typename T>
std::optional<std::uint64_t> number(std::string_view text) {
  T value{};
  if (!base::parse(std::span<const char>(text.data(), text.size()), value)) return std::nullopt;
  return bits_of(value);
}

std::optional<std::uint64_t> integer(ElementaryType type, std::string_view text) {
  const unsigned bits = 8 * bytecode::size_of(bytecode::mem_type(type));
  const std::span<const char> chars(text.data(), text.size());
  if (bytecode::is_unsigned(type)) {
    std::uint64_t value = 0;
    if (!base::parse(chars, value) || (bits < 64 && value >> bits != 0)) return std::nullopt;
    return value;
  }
  std::int64_t value = 0;
  if (!base::parse(chars, value)) return std::nullopt;
  const std::int64_t highest = std::numeric_limits<std::int64_t>::max() >> (64 - bits);
  if (value > highest || value < -highest - 1) return std::nullopt;
  return static_cast<std::uint64_t>(value) & (std::numeric_limits<std::uint64_t>::max() >> (64 - bits));
}

std::optional<std::uint64_t> time(bool (*parse)(std::span<const char>, std::int64_t&),
                                  std::string_view text) {
  std::int64_t ns = 0;
  if (!parse(std::span<const char>(text.data(), text.size()), ns)) return std::nullopt;
  return bits_of(ns);
}

std::optional<std::uint64_t> enumerator(const Variable& variable, std::string_view text) {
  const std::string_view name = text.substr(text.find('#') + 1);  // npos + 1 is the front
  for (const auto& [value, known] : *variable.enumerators) {
    if (!naming::same_name(known, name)) continue;
    const unsigned bits = 8 * bytecode::size_of(bytecode::mem_type(variable.type));
    return static_cast<std::uint64_t>(value) & (std::numeric_limits<std::uint64_t>::max() >> (64 - bits));
  }
  return std::nullopt;
}

// 'a' or "a": one character of ASCII.
std::optional<std::uint64_t> character(std::string_view text) {
  const bool quoted = text.size() == 3 && (text[0] == '\'' || text[0] == '"') && text[2] == text[0];
  if (!quoted || static_cast<unsigned char>(text[1]) >= 0x80 || text[1] == '$') return std::nullopt;
  return static_cast<std::uint64_t>(text[1]);
}

std::optional<std::uint64_t> parse(const Variable& variable, std::string_view text) {
  if (variable.enumerators != nullptr) {
    if (const auto value = enumerator(variable, text)) return value;
  }
  const std::string_view plain = without_type(variable.type, text);
  switch (variable.type) {
    case ElementaryType::Bool:
      return number<bool>(plain);
    case ElementaryType::Real:
      return number<float>(plain);
    case ElementaryType::Lreal:
      return number<double>(plain);
    case ElementaryType::Time:
      return time(base::parse_time, text);
    case ElementaryType::Date:
      return time(base::parse_date, text);
    case ElementaryType::Tod:
      return time(base::parse_time_of_day, text);
    case ElementaryType::Dt:
      return time(base::parse_date_and_time, text);
    case ElementaryType::Char:
    case ElementaryType::Wchar:
      if (const auto value = character(plain)) return value;
      [[fallthrough]];
    default:
      return integer(variable.type, plain);
  }
}

const char* example_of(const Variable& variable) {
  switch (variable.type) {
    case ElementaryType::Bool:
      return "TRUE or FALSE";
    case ElementaryType::Real:
    case ElementaryType::Lreal:
      return "a number such as 3.5 or 1E-3";
    case ElementaryType::Time:
      return "a duration such as T#1s500ms";
    case ElementaryType::Date:
      return "a date such as D#2024-02-29";
    case ElementaryType::Tod:
      return "a time of day such as TOD#12:30:00";
    case ElementaryType::Dt:
      return "a date and time such as DT#2024-02-29-12:30:00";
    case ElementaryType::Char:
    case ElementaryType::Wchar:
      return "a character such as 'a' or its number";
    default:
      return "an integer in range such as 12 or 16#FF";
  }
}

}  // namespace

result::Result<std::uint64_t> parse_value(const Variable& variable, std::string_view text, const char* code,
                                          const result::Location& where) {
  const std::string type = bytecode::name_of(variable.type);
  if (bytecode::is_string(variable.type)) {
    return result::fail(code, where, "a " + type + " cannot be forced",
                        "it is longer than the 8 bytes that a force can hold: write it, or force what it is "
                        "made from");
  }
  if (const auto value = parse(variable, text)) return *value;
  std::string hint = std::string("a ") + type + " is " + example_of(variable);
  if (variable.enumerators != nullptr && !variable.enumerators->empty()) {
    hint = "its values are";
    for (const auto& [number, name] : *variable.enumerators) hint += " " + name;
  }
  return result::fail(code, where, "`" + std::string(text) + "` is no value of the type " + type, hint);
}

}  // namespace stepwright::reader

#include "runtime/bytecode/reader/read_value.h"

#include "runtime/base/number_text.h"
#include "runtime/base/time_text.h"
#include "runtime/ground/naming/text_literal.h"

#include <algorithm>
#include <charconv>
#include <cstring>

namespace stepwright::reader {

namespace {

template <typename T>
T read_as(std::span<const std::byte> image, std::uint32_t address) {
  T value;
  std::memcpy(&value, image.data() + address, sizeof(T));
  return value;
}

double shortest(float value) {
  char text[32];
  const auto written = std::to_chars(text, text + sizeof(text), value);
  double wide = value;
  std::from_chars(text, written.ptr, wide);
  return wide;
}

void append_utf8(std::string& text, std::uint32_t code_point) {
  const auto push = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code_point < 0x80) {
    push(code_point);
  } else if (code_point < 0x800) {
    push(0xC0 | code_point >> 6);
    push(0x80 | (code_point & 0x3F));
  } else {
    if (code_point < 0x10000) {
      push(0xE0 | code_point >> 12);
    } else {
      push(0xF0 | code_point >> 18);
      push(0x80 | (code_point >> 12 & 0x3F));
    }
    push(0x80 | (code_point >> 6 & 0x3F));
    push(0x80 | (code_point & 0x3F));
  }
}

// A STRING holds the first 256 code points, a WSTRING UTF-16; what is no character reads U+FFFD. Cut where
// the header lies.
template <typename Unit>
std::string string_at(std::span<const std::byte> image, std::uint32_t address) {
  constexpr std::uint32_t kReplacement = 0xFFFD;
  std::string text;
  if (address + std::size_t{bytecode::kStringHeaderBytes} > image.size()) return text;
  const auto characters = image.subspan(address + std::size_t{bytecode::kStringHeaderBytes});
  std::size_t length =
      std::min(read_as<std::uint16_t>(image, address), read_as<std::uint16_t>(image, address + 2));
  length = std::min(length, characters.size() / sizeof(Unit));
  const auto unit = [&](std::size_t i) -> std::uint32_t {
    return i < length ? read_as<Unit>(characters, static_cast<std::uint32_t>(i * sizeof(Unit))) : 0u;
  };
  for (std::size_t i = 0; i < length; ++i) {
    const bool high = unit(i) >= 0xD800 && unit(i) < 0xDC00;
    const bool pair = high && unit(i + 1) >= 0xDC00 && unit(i + 1) < 0xE000;
    const bool alone = !pair && unit(i) >= 0xD800 && unit(i) < 0xE000;
    append_utf8(text, pair    ? 0x10000 + ((unit(i) - 0xD800) << 10) + (unit(i + 1) - 0xDC00)
                      : alone ? kReplacement
                              : unit(i));
    if (pair) ++i;
  }
  return text;
}

std::string plain(const base::ShortText& text) {
  return {text.view().begin(), text.view().end()};
}

// A date or a duration; an enumerator; any other integer.
template <typename Integer>
std::string integer_text(const Variable& variable, Integer value) {
  using bytecode::ElementaryType;
  const auto ns = static_cast<std::int64_t>(value);
  if (variable.enumerators != nullptr) {
    const auto name = variable.enumerators->find(ns);
    if (name != variable.enumerators->end()) return name->second;
  }
  switch (variable.type) {
    case ElementaryType::Time:
      return plain(base::text_of_time(ns));
    case ElementaryType::Date:
      return plain(base::text_of_date(ns));
    case ElementaryType::Tod:
      return plain(base::text_of_time_of_day(ns));
    case ElementaryType::Dt:
      return plain(base::text_of_date_and_time(ns));
    default:
      return plain(base::text_of(value));
  }
}

}  // namespace

Value read_value(const Variable& variable, std::span<const std::byte> image) {
  using bytecode::ElementaryType;
  const std::uint32_t at = variable.address;
  switch (variable.type) {
    case ElementaryType::Bool: {
      const auto byte = read_as<std::uint8_t>(image, at);
      return variable.bit == bytecode::kNoBit ? byte != 0 : ((byte >> variable.bit) & 1) != 0;
    }
    case ElementaryType::Sint:
      return std::int64_t{read_as<std::int8_t>(image, at)};
    case ElementaryType::Int:
      return std::int64_t{read_as<std::int16_t>(image, at)};
    case ElementaryType::Dint:
      return std::int64_t{read_as<std::int32_t>(image, at)};
    case ElementaryType::Lint:
    case ElementaryType::Time:
    case ElementaryType::Date:
    case ElementaryType::Tod:
    case ElementaryType::Dt:
      return read_as<std::int64_t>(image, at);
    case ElementaryType::Usint:
    case ElementaryType::Byte:
    case ElementaryType::Char:
      return std::uint64_t{read_as<std::uint8_t>(image, at)};
    case ElementaryType::Uint:
    case ElementaryType::Word:
    case ElementaryType::Wchar:
      return std::uint64_t{read_as<std::uint16_t>(image, at)};
    case ElementaryType::Udint:
    case ElementaryType::Dword:
      return std::uint64_t{read_as<std::uint32_t>(image, at)};
    case ElementaryType::Ulint:
    case ElementaryType::Lword:
      return read_as<std::uint64_t>(image, at);
    case ElementaryType::Real:
      return shortest(read_as<float>(image, at));
    case ElementaryType::Lreal:
      return read_as<double>(image, at);
    case ElementaryType::String:
      return string_at<std::uint8_t>(image, at);
    case ElementaryType::Wstring:
      return string_at<std::uint16_t>(image, at);
  }
  return false;
}

double read_quantity(const Variable& variable, std::span<const std::byte> image) {
  constexpr double kNanosecondsPerSecond = 1e9;
  const double number = read_number(variable, image);
  return variable.type == bytecode::ElementaryType::Time ? number / kNanosecondsPerSecond : number;
}

std::string read_text(const Variable& variable, std::span<const std::byte> image) {
  struct Writer {
    const Variable& variable;
    std::string operator()(bool value) const { return value ? "TRUE" : "FALSE"; }
    std::string operator()(std::int64_t value) const { return integer_text(variable, value); }
    std::string operator()(std::uint64_t value) const { return integer_text(variable, value); }
    std::string operator()(double value) const { return plain(base::text_of(value)); }
    std::string operator()(const std::string& value) const { return value; }
  };
  return std::visit(Writer{variable}, read_value(variable, image));
}

std::string read_printable(const Variable& variable, std::span<const std::byte> image) {
  std::string text = read_text(variable, image);
  if (!bytecode::is_string(variable.type)) return text;
  const bool is_wide = variable.type == bytecode::ElementaryType::Wstring;
  return naming::literal_text(text, is_wide ? naming::TextWidth::Double : naming::TextWidth::Single);
}

}  // namespace stepwright::reader

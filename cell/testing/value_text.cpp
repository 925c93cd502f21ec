#include "cell/testing/value_text.h"

#include <cstdio>
#include <memory>

#include "runtime/bytecode/reader/read_value.h"

namespace stepwright::cell_testing {

namespace {

using bytecode::ElementaryType;

// Quotes, the escape sign and what cannot be printed stand behind a $ (IEC 61131-3, table 7).
std::string quoted(const std::string& text, char quote) {
  std::string out(1, quote);
  for (const char each : text) {
    const auto code = static_cast<unsigned char>(each);
    char hex[5];
    if (each == quote || each == '$') {
      out += '$';
      out += each;
    } else if (code < 0x20 || code == 0x7F) {
      std::snprintf(hex, sizeof(hex), quote == '"' ? "%04X" : "%02X", code);
      out += '$';
      out += hex;
    } else {
      out += each;
    }
  }
  return out + quote;
}

std::string character(std::uint64_t code, char quote) {
  const bool plain = code >= 0x20 && code < 0x7F;
  if (plain) return quoted(std::string(1, static_cast<char>(code)), quote);
  char text[8];
  std::snprintf(text, sizeof(text), quote == '"' ? "\"$%04X\"" : "'$%02X'", static_cast<unsigned>(code));
  return text;
}

std::string bits(std::uint64_t value, int digits) {
  char text[24];
  std::snprintf(text, sizeof(text), "16#%0*llX", digits, static_cast<unsigned long long>(value));
  return text;
}

}  // namespace

std::string value_text(const driver::TestOperand& operand, std::uint32_t instance,
                       std::span<const std::byte> image) {
  reader::Variable variable;
  variable.type = operand.type;
  variable.address = instance + operand.offset;
  if (!operand.enumerators.empty()) {
    variable.enumerators = std::make_shared<const reader::Enumerators>(operand.enumerators);
    return reader::read_text(variable, image);
  }
  const reader::Value value = reader::read_value(variable, image);
  const std::uint64_t* const count = std::get_if<std::uint64_t>(&value);
  switch (operand.type) {
    case ElementaryType::Byte:
      return bits(*count, 2);
    case ElementaryType::Word:
      return bits(*count, 4);
    case ElementaryType::Dword:
      return bits(*count, 8);
    case ElementaryType::Lword:
      return bits(*count, 16);
    case ElementaryType::Char:
      return character(*count, '\'');
    case ElementaryType::Wchar:
      return character(*count, '"');
    case ElementaryType::String:
      return quoted(std::get<std::string>(value), '\'');
    case ElementaryType::Wstring:
      return quoted(std::get<std::string>(value), '"');
    default:
      return reader::read_text(variable, image);
  }
}

}  // namespace stepwright::cell_testing

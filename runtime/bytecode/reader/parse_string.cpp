#include "runtime/bytecode/reader/parse_string.h"

#include <cstring>
#include <string>

#include "runtime/ground/naming/text_literal.h"

namespace stepwright::reader {
namespace {

// What stands between the quotes of the literal that `text` is or, without quotes, stands for.
std::string literal_of(std::string_view text, char quote) {
  if (text.size() >= 2 && text.front() == quote && text.back() == quote)
    return std::string(text.substr(1, text.size() - 2));
  std::string inside;
  for (const char c : text) inside.append(c == '$' ? 2 : 1, c);
  return inside;
}

void append_unit(std::vector<std::byte>& bytes, std::uint16_t unit, std::size_t size) {
  const std::size_t end = bytes.size();
  bytes.resize(end + size);
  std::memcpy(bytes.data() + end, &unit, size);
}

}  // namespace

result::Result<std::vector<std::byte>> parse_string(const Variable& variable, std::string_view text,
                                                    const char* code, const result::Location& where) {
  const bool wide = variable.type == bytecode::ElementaryType::Wstring;
  const std::string type = bytecode::name_of(variable.type);
  naming::TextMistake mistake;
  const auto characters =
      naming::parse_text(literal_of(text, wide ? '"' : '\''),
                         wide ? naming::TextWidth::Double : naming::TextWidth::Single, mistake);
  if (!characters) {
    return result::fail(code, where, "this is no text of the type " + type + ": " + mistake.message,
                        wide ? "in quotes `$` begins an escape: write $$, $\" or $20AC"
                             : "in quotes `$` begins an escape: write $$, $' or $41; a STRING has characters "
                               "up to 255, a WSTRING all");
  }
  if (characters->size() > variable.capacity) {
    return result::fail(code, where,
                        "the text has " + std::to_string(characters->size()) + " characters, the " + type +
                            " has room for " + std::to_string(variable.capacity),
                        "write less, or declare it longer");
  }
  std::vector<std::byte> bytes;
  append_unit(bytes, static_cast<std::uint16_t>(characters->size()), sizeof(std::uint16_t));
  for (const char16_t unit : *characters) append_unit(bytes, unit, bytecode::character_bytes(variable.type));
  return bytes;
}

}  // namespace stepwright::reader

#include "ladder/exchange/xml_encoding.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "ladder/source/codes.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/result/utf8_place.h"

namespace stepwright::exchange {
namespace {

using naming::same_name;

// Of "<?xml version="1.0" encoding="ISO-8859-1"?>" at the beginning; empty if none is declared.
std::string_view declared(std::string_view text) {
  if (text.starts_with(result::kByteOrderMark)) text.remove_prefix(result::kByteOrderMark.size());
  if (!text.starts_with("<?xml")) return {};
  text = text.substr(0, text.find("?>"));
  const std::size_t key = text.find("encoding");
  if (key == std::string_view::npos) return {};
  const std::size_t open = text.find_first_of("\"'", key);
  if (open == std::string_view::npos) return {};
  const std::size_t close = text.find(text[open], open + 1);
  return close == std::string_view::npos ? std::string_view() : text.substr(open + 1, close - open - 1);
}

// What Windows has from 0x80 to 0x9F, where ISO 8859-1 has control characters; nothing has those in mind.
constexpr std::array<std::uint16_t, 32> kWindows = {
    0x20AC, 0x0081, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0x008D, 0x017D, 0x008F, 0x0090, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x009D, 0x017E, 0x0178};

std::string from_latin(std::string_view text) {
  std::string whole;
  whole.reserve(text.size() + text.size() / 8);
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const std::uint16_t code = byte >= 0x80 && byte < 0xA0 ? kWindows.at(byte - 0x80U) : byte;
    if (code >= 0x800) whole += static_cast<char>(0xE0U | (code >> 12U));
    if (code >= 0x80)
      whole += static_cast<char>(code >= 0x800 ? 0x80U | ((code >> 6U) & 0x3FU) : 0xC0U | (code >> 6U));
    whole += static_cast<char>(code >= 0x80 ? 0x80U | (code & 0x3FU) : code);
  }
  return whole;
}

bool is_any_of(std::string_view name, std::initializer_list<std::string_view> names) {
  for (const std::string_view each : names)
    if (same_name(name, each)) return true;
  return false;
}

}  // namespace

result::Result<std::string> as_utf8(const std::string& name, std::string text) {
  const auto fail = [&](result::Location where, std::string message) {
    where.file = name;
    return result::fail(source::code::kBadXml, where, std::move(message), "save it with the encoding UTF-8");
  };
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    return fail({{}, 1, 1}, "the file is not UTF-8");
  const std::string encoding(declared(text));
  if (is_any_of(encoding, {"ISO-8859-1", "ISO8859-1", "latin1", "windows-1252", "cp1252"})) {
    text.replace(text.find(encoding), encoding.size(), "UTF-8");
    return from_latin(text);
  }
  if (!is_any_of(encoding, {"", "UTF-8", "UTF8", "US-ASCII", "ASCII"}))
    return fail({{}, 1, 1}, "the encoding '" + encoding + "' is not read");
  if (const auto broken = result::place_of_no_utf8(name, text))
    return fail(*broken, "this byte is not of UTF-8, which the file is to be");
  return text;
}

}  // namespace stepwright::exchange

#include "tests/st/literal.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "ladder/syntax/number.h"
#include "runtime/bytecode/reader/read_value.h"

namespace stepwright::st_test {

namespace {

using bytecode::ElementaryType;

std::int64_t duration(const std::string& text) {
  const auto value = syntax::parse_duration(text.substr(text.find('#') + 1));
  if (!value) throw std::runtime_error("not a duration: " + text);
  return *value;
}

// The bits of a whole number: "5", "-5", "16#FF", "T#1s".
std::uint64_t whole(const std::string& text) {
  if (text.rfind("T#", 0) == 0) return static_cast<std::uint64_t>(duration(text));
  const std::size_t based = text.find('#');
  std::size_t used = 0;
  std::uint64_t value = 0;
  try {
    if (based != std::string::npos) {
      value = std::stoull(text.substr(based + 1), &used, std::stoi(text));
      used += based + 1;
    } else {
      value = text.front() == '-' ? static_cast<std::uint64_t>(std::stoll(text, &used))
                                  : std::stoull(text, &used);
    }
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size()) throw std::runtime_error("not a number: " + text);
  return value;
}

double real(const std::string& text) {
  if (text == "INF") return std::numeric_limits<double>::infinity();
  if (text == "-INF") return -std::numeric_limits<double>::infinity();
  if (text == "NAN") return std::numeric_limits<double>::quiet_NaN();
  std::size_t used = 0;
  const double value = std::stod(text, &used);
  if (used != text.size()) throw std::runtime_error("not a number: " + text);
  return value;
}

// A REAL equals what its decimal form rounds to.
bool equals_real(double found, const std::string& expected, bool is_single) {
  const double wanted = is_single ? static_cast<float>(real(expected)) : real(expected);
  if (is_single) found = static_cast<float>(found);
  if (std::isnan(wanted)) return std::isnan(found);
  return found == wanted && std::signbit(found) == std::signbit(wanted);
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

// A date, or the name of an enumerator: as the reader writes it.
bool is_written(const std::string& text) {
  const bool date = text.rfind("D#", 0) == 0 || text.rfind("TOD#", 0) == 0 || text.rfind("DT#", 0) == 0;
  return date || std::isalpha(static_cast<unsigned char>(text.front())) != 0 || text.front() == '_';
}

std::string unquoted(const std::string& text) {
  if (text.size() < 2 || text.front() != text.back() || (text.front() != '\'' && text.front() != '"'))
    throw std::runtime_error("not a string: " + text);
  return text.substr(1, text.size() - 2);
}

// ASCII only: what a test sets.
void write_string(const reader::Variable& variable, const std::string& value, std::span<std::byte> image) {
  const std::uint32_t width = bytecode::character_bytes(variable.type);
  std::byte* header = image.data() + variable.address;
  std::uint16_t capacity = 0;
  std::memcpy(&capacity, header, 2);
  if (value.size() > capacity) throw std::runtime_error("too long: " + value);
  const auto length = static_cast<std::uint16_t>(value.size());
  std::memcpy(header + 2, &length, 2);
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto unit = static_cast<std::uint16_t>(value[i]);
    std::memcpy(header + 4 + i * width, &unit, width);
  }
}

}  // namespace

bool equals_literal(const reader::Variable& variable, const std::string& expected,
                    std::span<const std::byte> image) {
  if (expected.empty()) throw std::runtime_error("no value");
  const reader::Value value = reader::read_value(variable, image);
  if (const bool* flag = std::get_if<bool>(&value)) {
    if (expected != "TRUE" && expected != "FALSE") throw std::runtime_error("not a BOOL: " + expected);
    return *flag == (expected == "TRUE");
  }
  if (const double* found = std::get_if<double>(&value))
    return equals_real(*found, expected, variable.type == ElementaryType::Real);
  if (const auto* text = std::get_if<std::string>(&value)) return *text == unquoted(expected);
  if (expected.rfind("T#", 0) != 0 && is_written(expected))
    return upper(reader::read_text(variable, image)) == upper(expected);
  if (const auto* found = std::get_if<std::uint64_t>(&value)) return *found == whole(expected);
  return static_cast<std::uint64_t>(std::get<std::int64_t>(value)) == whole(expected);
}

void write_literal(const reader::Variable& variable, const std::string& value, std::span<std::byte> image) {
  if (bytecode::is_string(variable.type)) return write_string(variable, unquoted(value), image);
  std::byte* target = image.data() + variable.address;
  if (variable.type == ElementaryType::Bool) {
    if (value != "TRUE" && value != "FALSE") throw std::runtime_error("not a BOOL: " + value);
    const std::byte mask = variable.bit == bytecode::kNoBit ? std::byte{1} : std::byte{1} << variable.bit;
    *target = value == "TRUE" ? *target | mask : *target & ~mask;
  } else if (variable.type == ElementaryType::Real) {
    const auto single = static_cast<float>(real(value));
    std::memcpy(target, &single, sizeof(single));
  } else if (variable.type == ElementaryType::Lreal) {
    const double wide = real(value);
    std::memcpy(target, &wide, sizeof(wide));
  } else {
    const std::uint64_t bits = whole(value);
    std::memcpy(target, &bits, bytecode::size_of(bytecode::mem_type(variable.type)));
  }
}

std::string shown_value(const reader::Variable& variable, std::span<const std::byte> image) {
  const reader::Value value = reader::read_value(variable, image);
  if (const double* found = std::get_if<double>(&value)) {
    std::ostringstream out;
    out.precision(17);
    out << *found;
    return out.str();
  }
  if (const auto* text = std::get_if<std::string>(&value)) return "'" + *text + "'";
  return reader::read_text(variable, image);
}

}  // namespace stepwright::st_test

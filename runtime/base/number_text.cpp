#include "runtime/base/number_text.h"

#include <charconv>
#include <limits>

#include "runtime/base/text_cursor.h"

namespace stepwright::base {

namespace {

constexpr std::size_t kMaxRealText = 255;

// Without an exponent from 0.00001 up to 15 digits before the point: what people write.
template <typename Float>
ShortText text_of_real(Float value) {
  ShortText text;
  if (value != value) {
    text.push("NaN");
    return text;
  }
  const Float magnitude = value < 0 ? -value : value;
  if (magnitude > std::numeric_limits<Float>::max()) {
    text.push(value < 0 ? "-Infinity" : "Infinity");
    return text;
  }
  const bool plain = magnitude == 0 || (magnitude >= Float(1e-5) && magnitude < Float(1e15));
  char digits[ShortText::kCapacity];
  const auto written = std::to_chars(digits, digits + sizeof(digits), value,
                                     plain ? std::chars_format::fixed : std::chars_format::scientific);
  bool point = false;
  for (const char* at = digits; at != written.ptr; ++at) {
    point = point || *at == '.';
    if (*at == 'e' && !point) text.push(".0");
    text.push(*at == 'e' ? 'E' : *at);
  }
  if (plain && !point) text.push(".0");
  return text;
}

bool take_sign(TextCursor& cursor) {
  if (cursor.take('-')) return true;
  static_cast<void>(cursor.take('+'));
  return false;
}

// Sign and magnitude of a whole integer literal.
bool take_integer(std::span<const char> text, bool& negative, std::uint64_t& magnitude) {
  TextCursor cursor(text);
  negative = take_sign(cursor);
  std::uint32_t base = 10;
  if (cursor.take_word("16#")) {
    base = 16;
  } else if (cursor.take_word("8#")) {
    base = 8;
  } else if (cursor.take_word("2#")) {
    base = 2;
  }
  return cursor.take_number(magnitude, base) && cursor.at_end();
}

// Copies a whole real literal without its underscores and its plus sign, as from_chars takes it.
class RealDigits {
 public:
  bool read(std::span<const char> text) {
    if (text.size() > kMaxRealText) return false;
    TextCursor cursor(text);
    if (take_sign(cursor)) push('-');
    if (!digits(cursor)) return false;
    if (cursor.take('.')) {
      push('.');
      if (!digits(cursor)) return false;
    }
    if (cursor.take_word("E")) {
      push('e');
      if (take_sign(cursor)) push('-');
      if (!digits(cursor)) return false;
    }
    return cursor.at_end();
  }

  template <typename Float>
  bool convert(Float& value) const {
    const auto result = std::from_chars(chars_, chars_ + size_, value);
    return result.ec == std::errc() && result.ptr == chars_ + size_;
  }

 private:
  bool digits(TextCursor& cursor) {
    std::uint32_t digit = 0;
    if (!cursor.take_digit(10, digit)) return false;
    do {
      push(static_cast<char>('0' + digit));
    } while (cursor.take_next_digit(10, digit));
    return true;
  }
  void push(char c) { chars_[size_++] = c; }  // never more than were read

  char chars_[kMaxRealText];
  std::size_t size_ = 0;
};

template <typename Float>
bool parse_real(std::span<const char> text, Float& value) {
  RealDigits digits;
  Float number = 0;
  if (!digits.read(text) || !digits.convert(number)) return false;
  value = number;
  return true;
}

}  // namespace

ShortText text_of(std::int64_t value) {
  ShortText text;
  const auto bits = static_cast<std::uint64_t>(value);
  if (value < 0) text.push('-');
  text.push_number(value < 0 ? 0 - bits : bits);
  return text;
}

ShortText text_of(std::uint64_t value) {
  ShortText text;
  text.push_number(value);
  return text;
}

ShortText text_of(float value) {
  return text_of_real(value);
}

ShortText text_of(double value) {
  return text_of_real(value);
}

bool parse(std::span<const char> text, std::int64_t& value) {
  constexpr auto kLargest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  bool negative = false;
  std::uint64_t magnitude = 0;
  if (!take_integer(text, negative, magnitude) || magnitude > kLargest + (negative ? 1 : 0)) return false;
  value = static_cast<std::int64_t>(negative ? 0 - magnitude : magnitude);
  return true;
}

bool parse(std::span<const char> text, std::uint64_t& value) {
  bool negative = false;
  std::uint64_t magnitude = 0;
  if (!take_integer(text, negative, magnitude) || (negative && magnitude != 0)) return false;
  value = magnitude;
  return true;
}

bool parse(std::span<const char> text, float& value) {
  return parse_real(text, value);
}

bool parse(std::span<const char> text, double& value) {
  return parse_real(text, value);
}

bool parse(std::span<const char> text, bool& value) {
  TextCursor cursor(text);
  const bool yes = cursor.take_word("TRUE") || cursor.take('1');
  const bool no = !yes && (cursor.take_word("FALSE") || cursor.take('0'));
  if ((!yes && !no) || !cursor.at_end()) return false;
  value = yes;
  return true;
}

}  // namespace stepwright::base

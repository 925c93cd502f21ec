#include "firmware/decimal/characters.h"

#include <bit>
#include <cstdint>

#include "firmware/decimal/decimal.h"

namespace stepwright::decimal {
namespace {

constexpr int kMaxDigits = 255;

template <typename Float>
struct Layout;
template <>
struct Layout<float> {
  using Bits = std::uint32_t;
  static constexpr Format kFormat = kSingle;
};
template <>
struct Layout<double> {
  using Bits = std::uint64_t;
  static constexpr Format kFormat = kDouble;
};

// Without its sign.
template <typename Float>
Binary binary_of(Float value) {
  using Bits = typename Layout<Float>::Bits;
  constexpr Format kFormat = Layout<Float>::kFormat;
  constexpr int kFraction = kFormat.mantissa_bits - 1;
  const Bits bits = std::bit_cast<Bits>(value) & ~Bits{0} >> 1;
  const Bits hidden = Bits{1} << kFraction;
  const int exponent = static_cast<int>(bits >> kFraction);
  const int lowest = kFormat.min_exponent - kFraction;
  if (exponent == 0) return {bits, lowest};
  return {(bits & (hidden - 1)) | hidden, lowest + exponent - 1};
}

template <typename Float>
Float value_of(const Binary& number, bool negative) {
  using Bits = typename Layout<Float>::Bits;
  constexpr Format kFormat = Layout<Float>::kFormat;
  constexpr int kFraction = kFormat.mantissa_bits - 1;
  const auto mantissa = static_cast<Bits>(number.mantissa);
  const Bits hidden = Bits{1} << kFraction;
  Bits bits = mantissa;
  if (mantissa >= hidden)
    bits = (mantissa - hidden) | static_cast<Bits>(number.exponent - (kFormat.min_exponent - kFraction) + 1)
                                     << kFraction;
  if (negative) bits |= ~(~Bits{0} >> 1);
  return std::bit_cast<Float>(bits);
}

char* put_number(char* at, std::uint64_t value) {
  if (value >= 10) at = put_number(at, value / 10);
  *at = static_cast<char>('0' + value % 10);
  return at + 1;
}

char* put_digits(char* at, const Digits& digits, int first, int count) {
  for (int i = first; i < first + count; ++i)
    *at++ =
        static_cast<char>('0' + (i >= 0 && i < digits.count ? digits.digit[static_cast<std::size_t>(i)] : 0));
  return at;
}

// Digits before the point, then what is left of them behind it.
char* put_fixed(char* at, const Digits& digits) {
  if (digits.exponent <= 0) {
    *at++ = '0';
  } else {
    at = put_digits(at, digits, 0, digits.exponent);
  }
  if (digits.count <= digits.exponent) return at;
  *at++ = '.';
  const int first = digits.exponent > 0 ? digits.exponent : 0;
  for (int zero = digits.exponent; zero < 0; ++zero) *at++ = '0';
  return put_digits(at, digits, first, digits.count - first);
}

// One digit before the point; two of the exponent at least.
char* put_scientific(char* at, const Digits& digits) {
  at = put_digits(at, digits, 0, 1);
  if (digits.count > 1) {
    *at++ = '.';
    at = put_digits(at, digits, 1, digits.count - 1);
  }
  const int exponent = digits.exponent - 1;
  *at++ = 'e';
  *at++ = exponent < 0 ? '-' : '+';
  const auto magnitude = static_cast<std::uint64_t>(exponent < 0 ? -exponent : exponent);
  if (magnitude < 10) *at++ = '0';
  return put_number(at, magnitude);
}

template <typename Float>
std::to_chars_result write(char* at, Float value, std::chars_format format) {
  using Bits = typename Layout<Float>::Bits;
  if (std::bit_cast<Bits>(value) >> (sizeof(Bits) * 8 - 1) != 0) {
    *at++ = '-';
    value = -value;
  }
  const bool fixed = format == std::chars_format::fixed;
  // A whole number has all its digits: zeros in their place would be as short, but not as near.
  if (fixed && value == static_cast<Float>(static_cast<std::uint64_t>(value)))
    return {put_number(at, static_cast<std::uint64_t>(value)), std::errc()};
  if (value == 0) {
    for (const char* zero = "0e+00"; *zero != '\0'; ++zero) *at++ = *zero;
    return {at, std::errc()};
  }
  const Digits digits = shortest(binary_of(value), Layout<Float>::kFormat);
  return {fixed ? put_fixed(at, digits) : put_scientific(at, digits), std::errc()};
}

bool is_digit(const char* at, const char* last) {
  return at != last && *at >= '0' && *at <= '9';
}

int take_exponent(const char*& at, const char* last) {
  constexpr int kBeyondAll = 100'000;
  const bool negative = at != last && *at == '-';
  if (negative || (at != last && *at == '+')) ++at;
  int exponent = 0;
  for (; is_digit(at, last); ++at) {
    exponent = exponent * 10 + (*at - '0');
    if (exponent > kBeyondAll) exponent = kBeyondAll;
  }
  return negative ? -exponent : exponent;
}

template <typename Float>
std::from_chars_result read(const char* first, const char* last, Float& value) {
  const char* at = first;
  const bool negative = at != last && *at == '-';
  if (negative) ++at;
  char digits[kMaxDigits];
  int count = 0;
  int exponent = 0;
  for (; is_digit(at, last) && count < kMaxDigits; ++at) digits[count++] = static_cast<char>(*at - '0');
  if (count == 0) return {first, std::errc::invalid_argument};
  if (at != last && *at == '.') {
    for (++at; is_digit(at, last) && count < kMaxDigits; ++at, --exponent)
      digits[count++] = static_cast<char>(*at - '0');
  }
  if (at != last && *at == 'e') exponent += take_exponent(++at, last);
  Binary number;
  if (!nearest(digits, count, exponent, Layout<Float>::kFormat, number))
    return {at, std::errc::result_out_of_range};
  value = value_of<Float>(number, negative);
  return {at, std::errc()};
}

}  // namespace

std::to_chars_result to_characters(char* first, char*, float value, std::chars_format format) {
  return write(first, value, format);
}
std::to_chars_result to_characters(char* first, char*, double value, std::chars_format format) {
  return write(first, value, format);
}
std::from_chars_result from_characters(const char* first, const char* last, float& value) {
  return read(first, last, value);
}
std::from_chars_result from_characters(const char* first, const char* last, double& value) {
  return read(first, last, value);
}

}  // namespace stepwright::decimal

#include "firmware/decimal/decimal.h"

#include "firmware/decimal/big_number.h"

namespace stepwright::decimal {
namespace {

// The number is r / s; half the way to its neighbours is above / s and below / s.
struct Fraction {
  BigNumber r, s, above, below;
};

Fraction fraction_of(const Binary& number, bool nearer_below) {
  Fraction f{BigNumber(number.mantissa), BigNumber(1), BigNumber(1), BigNumber(1)};
  // Twice of everything, four times where the neighbour below is half as far.
  const int extra = nearer_below ? 2 : 1;
  f.r.shift_left(extra);
  f.s.shift_left(extra);
  if (nearer_below) f.above.shift_left(1);
  if (number.exponent >= 0) {
    f.r.shift_left(number.exponent);
    f.above.shift_left(number.exponent);
    f.below.shift_left(number.exponent);
  } else {
    f.s.shift_left(-number.exponent);
  }
  return f;
}

// Whether a number that is as high as r + above is still outside.
bool too_high(const Fraction& f, bool even) {
  BigNumber high = f.r;
  high.add(f.above);
  const int order = high.compare(f.s);
  return even ? order >= 0 : order > 0;
}

// Scales so that 0.1 <= (r + above) / s < 1 (or <= 1); the power of ten that was taken out.
int scale(Fraction& f, bool even, int bits) {
  // log10(2) = 0.30103; not above the exponent, at most one below it.
  int exponent = static_cast<int>((std::int64_t{bits} * 30103 - (bits < 0 ? 99999 : 0)) / 100000) - 1;
  if (exponent >= 0) {
    f.s.multiply_by_power_of_ten(exponent);
  } else {
    f.r.multiply_by_power_of_ten(-exponent);
    f.above.multiply_by_power_of_ten(-exponent);
    f.below.multiply_by_power_of_ten(-exponent);
  }
  while (too_high(f, even)) {
    f.s.multiply(10);
    ++exponent;
  }
  return exponent;
}

// The next digit: r / s, which is below 10.
int take_digit(Fraction& f) {
  f.r.multiply(10);
  f.above.multiply(10);
  f.below.multiply(10);
  int digit = 0;
  for (; f.r.compare(f.s) >= 0; ++digit) f.r.subtract(f.s);
  return digit;
}

// The last digit goes up if what is left is more than half of it, or half and the digit is odd.
bool rounds_up(Fraction& f, int digit) {
  f.r.shift_left(1);
  const int half = f.r.compare(f.s);
  return half > 0 || (half == 0 && digit % 2 != 0);
}

// N / d in [1, 2) after taking out a power of two, which it returns.
int normalise(BigNumber& n, BigNumber& d) {
  int exponent = n.bits() - d.bits();
  if (exponent > 0) d.shift_left(exponent);
  if (exponent < 0) n.shift_left(-exponent);
  if (n.compare(d) < 0) {
    n.shift_left(1);
    --exponent;
  }
  return exponent;
}

// The first `count` bits of n / d, which is below 2, rounded to nearest, ties to even.
std::uint64_t rounded_bits(BigNumber& n, const BigNumber& d, int count) {
  std::uint64_t bits = 0;
  bool next = false;
  for (int i = 0; i <= count; ++i) {
    next = n.compare(d) >= 0;
    if (next) n.subtract(d);
    if (i == count) break;
    bits = bits << 1 | (next ? 1 : 0);
    n.shift_left(1);
  }
  return next && (!n.zero() || bits % 2 != 0) ? bits + 1 : bits;
}

}  // namespace

Digits shortest(const Binary& number, const Format& format) {
  const bool even = number.mantissa % 2 == 0;
  const bool lowest = number.exponent == format.min_exponent - format.mantissa_bits + 1;
  const bool power = number.mantissa == std::uint64_t{1} << (format.mantissa_bits - 1);
  Fraction f = fraction_of(number, power && !lowest);
  Digits out;
  out.exponent = scale(f, even, static_cast<int>(std::bit_width(number.mantissa)) + number.exponent);
  for (;;) {
    const int digit = take_digit(f);
    const int below = f.r.compare(f.below);
    const bool low = even ? below <= 0 : below < 0;
    const bool high = too_high(f, even);
    const bool last = low || high;
    const bool up = last && (!low || (high && rounds_up(f, digit)));
    out.digit[static_cast<std::size_t>(out.count++)] = static_cast<char>(digit + (up ? 1 : 0));
    if (last) return out;
  }
}

bool nearest(const char* digits, int count, int exponent, const Format& format, Binary& number) {
  while (count > 0 && *digits == 0) {
    ++digits;
    --count;
  }
  number = {0, format.min_exponent - format.mantissa_bits + 1};
  if (count == 0) return true;
  if (count + exponent > 310 || count + exponent < -330) return false;
  BigNumber n;
  for (int i = 0; i < count; ++i) n.multiply(10, static_cast<std::uint32_t>(digits[i]));
  BigNumber d(1);
  (exponent >= 0 ? n : d).multiply_by_power_of_ten(exponent >= 0 ? exponent : -exponent);
  const int power = normalise(n, d);
  const int missing = power < format.min_exponent ? format.min_exponent - power : 0;
  if (missing > format.mantissa_bits) return false;
  number.mantissa = rounded_bits(n, d, format.mantissa_bits - missing);
  number.exponent = (missing > 0 ? format.min_exponent : power) - format.mantissa_bits + 1;
  if (number.mantissa >> format.mantissa_bits != 0) {
    number.mantissa >>= 1;
    ++number.exponent;
  }
  return number.mantissa != 0 && number.exponent + format.mantissa_bits - 1 <= format.max_exponent;
}

}  // namespace stepwright::decimal

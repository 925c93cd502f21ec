#pragma once

// Floating-point numbers and decimal digits, exactly: what std::to_chars and std::from_chars do, in three
// kilobytes of code instead of two hundred of tables. Slow: some hundred microseconds of a small processor
// for an ordinary number, milliseconds for the most extreme ones.
//
// No heap, any thread; a kilobyte of stack.

#include <array>
#include <cstdint>

namespace stepwright::decimal {

// Parameters of a binary format.
struct Format {
  int mantissa_bits;  // with the hidden one
  int min_exponent;   // of the smallest normal number, as a power of 2
  int max_exponent;   // of the largest number
};
inline constexpr Format kSingle{24, -126, 127};
inline constexpr Format kDouble{53, -1022, 1023};

// mantissa * 2^exponent, normalised as the format does it.
struct Binary {
  std::uint64_t mantissa = 0;
  int exponent = 0;
};

// 0.d1d2d3... * 10^exponent.
struct Digits {
  std::array<char, 17> digit{};  // values, not characters
  int count = 0;
  int exponent = 0;
};

// The fewest digits that give the number back when they are read, and of those the nearest; ties to even
// (Steele and White 1990, Dragon4). Requires a mantissa that is not 0.
Digits shortest(const Binary& number, const Format& format);

// The nearest number of the format, ties to even, of a decimal [d1 .. dn] * 10^exponent; at most 255 digits
// (their values). False if it is beyond the format: too large, or not zero and rounded to zero.
bool nearest(const char* digits, int count, int exponent, const Format& format, Binary& number);

}  // namespace stepwright::decimal

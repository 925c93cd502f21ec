#pragma once

// States are arrays of words; these are the words and the bit tricks on them.
//
// Thread rule: pure functions.

#include <algorithm>
#include <bit>
#include <cstdint>

namespace stepwright::pddl {

using Word = std::uint64_t;

inline bool bit(const Word* words, int place) {
  return (words[place >> 6] >> (place & 63) & 1) != 0;
}

// The place of the first bit that is set in [first, first + count), counted from `first`; `count` if none is.
inline int first_bit(const Word* words, int first, int count) {
  const Word* word = words + (first >> 6);
  const int offset = first & 63;
  if (const Word bits = *word >> offset) return std::min(std::countr_zero(bits), count);
  for (int seen = 64 - offset; seen < count; seen += 64) {
    if (const Word bits = *++word) return std::min(seen + std::countr_zero(bits), count);
  }
  return count;
}

// How many bits a number below `values` needs.
inline int bits_for(std::uint64_t values) {
  return values <= 1 ? 0 : 64 - std::countl_zero(values - 1);
}

}  // namespace stepwright::pddl

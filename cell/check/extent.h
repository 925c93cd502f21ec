#pragma once

// The bits of the image that something takes. Values.

#include <compare>
#include <cstdint>

#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::check {

struct Extent {
  std::uint64_t first = 0;
  std::uint64_t end = 0;  // the bit behind the last one

  friend auto operator<=>(const Extent&, const Extent&) = default;
};

inline bool overlap(const Extent& a, const Extent& b) {
  return a.first < b.end && b.first < a.end;
}

// Of a string: its header.
inline Extent extent_of(const reader::Variable& variable) {
  const std::uint64_t first = std::uint64_t{variable.address} * 8;
  if (variable.bit != bytecode::kNoBit) return {first + variable.bit, first + variable.bit + 1};
  if (bytecode::is_string(variable.type)) return {first, first + 8 * bytecode::kStringHeaderBytes};
  return {first, first + 8 * std::uint64_t{bytecode::size_of(bytecode::mem_type(variable.type))}};
}

}  // namespace stepwright::check

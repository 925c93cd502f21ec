#pragma once

// Standard functions that are not worth an opcode of their own. All but the elementary ones are exact.

#include <bit>
#include <cstdint>

#include "runtime/bytecode/opcode.h"
#include "runtime/operations/slot.h"

namespace stepwright::operations {

inline bool is_infinite(float x) {
  return (std::bit_cast<std::uint32_t>(x) & 0x7FFFFFFFu) == 0x7F800000u;
}
inline bool is_infinite(double x) {
  return (std::bit_cast<std::uint64_t>(x) & 0x7FFFFFFFFFFFFFFFull) == 0x7FF0000000000000ull;
}

// Replaces the arguments below `sp` by the result. False (and nothing changed) for an argument outside the
// function's domain.
bool call_intrinsic(bytecode::IntrinsicId id, Slot*& sp);

}  // namespace stepwright::operations

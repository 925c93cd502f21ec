#pragma once

// Members of structures that are a bit of their byte (IEC 61131-3, 6.4.4.7): the flags of a MemberRecord say
// which. Beside MemberFlag. Pure; no heap.
//
//   record.flags = bit_member(3);   member_bit(record.flags)  ->  3

#include <cstdint>

#include "runtime/bytecode/container_format.h"

namespace stepwright::bytecode {

inline constexpr std::uint32_t kMemberBit = 4;
inline constexpr std::uint32_t kMemberBitShift = 8;
inline constexpr std::uint32_t kMemberBitMask = kMemberBit | 7u << kMemberBitShift;

// The flags of a BOOL that is bit 0..7 of its byte.
constexpr std::uint32_t bit_member(std::uint8_t bit) {
  return kMemberBit | std::uint32_t{bit} << kMemberBitShift;
}

// The bit that flags say; kNoBit if the member begins at its byte.
constexpr std::uint8_t member_bit(std::uint32_t flags) {
  return (flags & kMemberBit) == 0 ? kNoBit : static_cast<std::uint8_t>(flags >> kMemberBitShift & 7);
}

}  // namespace stepwright::bytecode

#pragma once

// The registers of x86-64 as the generated code uses them.

#include <cstdint>

#include <asmjit/x86.h>

#include "runtime/native/internal/context.h"

namespace stepwright::native {

// The memory, the running instance, what is left of the budget, the context.
inline constexpr asmjit::x86::Gp kImage = asmjit::x86::rbx;
inline constexpr asmjit::x86::Gp kSelf = asmjit::x86::rbp;
inline constexpr asmjit::x86::Gp kBudget = asmjit::x86::r12;
inline constexpr asmjit::x86::Gp kContext = asmjit::x86::r13;

// Registers by one number: 0..15 general, 16..31 of floating point.
using RegisterId = std::uint8_t;
inline constexpr RegisterId kNoRegister = 0xFF;
inline constexpr RegisterId kFirstXmm = 16;
inline constexpr RegisterId kRegisterCount = 32;

inline constexpr RegisterId kRax = 0;
inline constexpr RegisterId kRcx = 1;
inline constexpr RegisterId kRdx = 2;
inline constexpr RegisterId kXmm0 = kFirstXmm;

constexpr bool is_xmm(RegisterId id) {
  return id >= kFirstXmm;
}

inline asmjit::x86::Xmm xmm(RegisterId id) {
  return asmjit::x86::xmm(id - kFirstXmm);
}
inline asmjit::x86::Gp gp8(RegisterId id) {
  return asmjit::x86::gpb_lo(id);
}
inline asmjit::x86::Gp gp16(RegisterId id) {
  return asmjit::x86::gpw(id);
}
inline asmjit::x86::Gp gp32(RegisterId id) {
  return asmjit::x86::gpd(id);
}
inline asmjit::x86::Gp gp64(RegisterId id) {
  return asmjit::x86::gpq(id);
}

// The lowest 1, 2, 4 or 8 bytes of a general register.
inline asmjit::x86::Gp general(RegisterId id, std::uint32_t bytes) {
  return bytes == 1 ? gp8(id) : bytes == 2 ? gp16(id) : bytes == 4 ? gp32(id) : gp64(id);
}

// The general registers that hold values, those for short-lived ones first: the last may be given to a loop.
inline constexpr RegisterId kGeneral[] = {0, 1, 2, 6, 7, 8, 9, 10, 14, 15};
inline constexpr std::uint32_t kLoopGeneral = 5;  // of them at most, from the back
inline constexpr std::uint32_t kLoopXmm = 10;     // of xmm0..xmm15, from the back

// Holds nothing from one instruction of the bytecode to the next.
inline constexpr RegisterId kScratch = 11;

}  // namespace stepwright::native

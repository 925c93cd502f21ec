#pragma once

// The registers of AArch64 as the generated code uses them.

#include <cstdint>

#include <asmjit/core.h>

#include <asmjit/arm/a64assembler.h>

#include "runtime/bytecode/value_type.h"
#include "runtime/native/internal/context.h"

namespace stepwright::native::a64 {

using asmjit::a64::Assembler;
using asmjit::arm::CondCode;
using asmjit::arm::Gp;
using asmjit::arm::GpW;
using asmjit::arm::GpX;
using asmjit::arm::Mem;
using asmjit::arm::ptr;
using asmjit::arm::ptr_post;
using asmjit::arm::ptr_pre;
using asmjit::arm::Vec;
using asmjit::arm::VecD;
using asmjit::arm::VecS;

// The context, the memory, the running instance, what is left of the budget. A called function keeps them.
inline constexpr GpX kContext(19);
inline constexpr GpX kImage(20);
inline constexpr GpX kSelf(21);
inline constexpr GpX kBudget(22);

// Hold nothing from one instruction of the bytecode to the next: one for values, one for addresses.
inline constexpr std::uint32_t kScratch = 16;
inline constexpr std::uint32_t kAddress = 17;

// Registers of values by one number: 0..15 general, from 16 on of floating point. v8 to v15 belong to the
// caller of the code.
using RegisterId = std::uint8_t;
inline constexpr RegisterId kNoRegister = 0xFF;
inline constexpr RegisterId kFirstVector = 16;
inline constexpr RegisterId kRegisterCount = kFirstVector + 32;

constexpr bool is_vector(RegisterId id) {
  return id >= kFirstVector;
}
constexpr bool holds_values(RegisterId id) {
  return id < kFirstVector + 8 || id >= kFirstVector + 16;
}

constexpr bool is_float(bytecode::StackType type) {
  return type == bytecode::StackType::F32 || type == bytecode::StackType::F64;
}

inline GpW w(std::uint32_t id) {
  return GpW(id);
}
inline GpX x(std::uint32_t id) {
  return GpX(id);
}
inline VecS s(RegisterId id) {
  return VecS(id - kFirstVector);
}
inline VecD d(RegisterId id) {
  return VecD(id - kFirstVector);
}

// The register as wide as a value of this type.
inline Gp general(RegisterId id, bytecode::StackType type) {
  const bool narrow = type == bytecode::StackType::Bool || type == bytecode::StackType::I32;
  return narrow ? static_cast<Gp>(w(id)) : static_cast<Gp>(x(id));
}
inline Vec vector(RegisterId id, bytecode::StackType type) {
  return type == bytecode::StackType::F32 ? static_cast<Vec>(s(id)) : static_cast<Vec>(d(id));
}

}  // namespace stepwright::native::a64

#pragma once

// One operand as the x86-64 translator knows it: a constant, a value in a register, a load or an address that
// no instruction has computed yet, or a comparison whose result is still in the flags. A plain value; one
// thread.

#include <cstdint>

#include "runtime/bytecode/container_format.h"
#include "runtime/bytecode/value_type.h"
#include "runtime/native/internal/extent.h"
#include "runtime/native/internal/x86/machine.h"

namespace stepwright::native {

// How machine code addresses a place in memory: fixed, or with an index that counts 1 << shift bytes. Which
// bytes an access there may touch is not told from this but from its effect (memory_effects.h).
struct Location {
  Space space = Space::Image;
  std::uint64_t offset = 0;
  RegisterId index = kNoRegister;
  std::uint8_t shift = 0;

  bool fixed() const { return index == kNoRegister; }
};

struct Value {
  enum class Kind : std::uint8_t { Constant, Register, Load, Address, Flags };

  Kind kind = Kind::Constant;
  bytecode::StackType type = bytecode::StackType::I32;
  RegisterId reg = kNoRegister;
  bytecode::MemType memory = bytecode::MemType::I32;               // Load
  std::uint8_t bit = bytecode::kNoBit;                             // Load of one bit
  bool plain = true;                                               // Load of a Bool: the byte is 0 or 1
  bool inverted = false;                                           // Load of a Bool or bit
  asmjit::x86::CondCode condition = asmjit::x86::CondCode::kZero;  // Flags
  Location location;                                               // Load, Address
  Extent where;                                                    // Load: the bytes that it may read
  std::uint64_t constant = 0;

  static Value of_constant(bytecode::StackType type, std::uint64_t bits) {
    Value value;
    value.type = type;
    value.constant = bits;
    return value;
  }
  static Value of_register(bytecode::StackType type, RegisterId reg) {
    Value value;
    value.kind = Kind::Register;
    value.type = type;
    value.reg = reg;
    return value;
  }
  static Value of_load(bytecode::MemType memory, const Location& location, const Extent& where) {
    Value value;
    value.kind = Kind::Load;
    value.type = stack_type(memory);
    value.memory = memory;
    value.location = location;
    value.where = where;
    return value;
  }
  // Of a slot, or of what else lies at a fixed place.
  static Value of_load(bytecode::MemType memory, const Location& location) {
    return of_load(memory, location, {location.space, location.offset, location.offset + size_of(memory)});
  }
  static Value of_address(const Location& location) {
    Value value;
    value.kind = Kind::Address;
    value.type = bytecode::StackType::Ref;
    value.location = location;
    return value;
  }

  bool is(Kind other) const { return kind == other; }
  // The register that this value needs to stay as it is.
  RegisterId held() const { return kind == Kind::Register ? reg : location.index; }
  std::uint32_t bytes() const { return bit == bytecode::kNoBit ? size_of(memory) : 1; }
};

constexpr bool is_float(bytecode::StackType type) {
  return type == bytecode::StackType::F32 || type == bytecode::StackType::F64;
}

// Bytes of a value in a register.
constexpr std::uint32_t width_of(bytecode::StackType type) {
  using bytecode::StackType;
  if (type == StackType::Bool) return 1;
  return type == StackType::I32 || type == StackType::F32 ? 4 : 8;
}

}  // namespace stepwright::native

#pragma once

// Machine types of the types of a program, and the instructions that compute with them. Pure functions;
// internal to this folder.

#include "ladder/semantics/types/type.h"
#include "ladder/syntax/expression.h"
#include "runtime/bytecode/opcode.h"

namespace stepwright::codegen {

enum class Machine : std::uint8_t { Bool, I32, I64, F32, F64, U32, U64, Ref };

// Requires a scalar type. Narrow unsigned integers fit a signed I32, yet compare and divide as U32 just as
// well.
Machine machine_type(const semantics::Type& type);
constexpr bool is_wide(Machine machine) {
  return machine == Machine::I64 || machine == Machine::U64;
}
// The integer that a conversion from a real number must reach.
bytecode::IntType int_type(const semantics::Type& type);

// Requires an operator that the machine has for these operands.
bytecode::Opcode binary_opcode(syntax::Operator op, Machine machine);
bytecode::IntrinsicId abs_intrinsic(Machine machine);
bytecode::IntrinsicId extremum_intrinsic(bool maximum, Machine machine);

}  // namespace stepwright::codegen

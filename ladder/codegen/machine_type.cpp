#include "ladder/codegen/machine_type.h"

#include <cassert>
#include <cstddef>

namespace stepwright::codegen {

using bytecode::IntrinsicId;
using bytecode::Opcode;
using syntax::Operator;

Machine machine_type(const semantics::Type& type) {
  using enum bytecode::StackType;
  assert(type.is_scalar() && !type.is_literal());
  switch (semantics::slot_type(type)) {
    case Bool:
      return Machine::Bool;
    case F32:
      return Machine::F32;
    case F64:
      return Machine::F64;
    case Ref:
      return Machine::Ref;
    case I64:
      return type.is_unsigned() ? Machine::U64 : Machine::I64;
    default:
      return type.is_unsigned() ? Machine::U32 : Machine::I32;
  }
}

bytecode::IntType int_type(const semantics::Type& type) {
  using enum bytecode::IntType;
  const bool is_unsigned = type.is_unsigned();
  switch (type.size) {
    case 1:
      return is_unsigned ? U8 : I8;
    case 2:
      return is_unsigned ? U16 : I16;
    case 4:
      return is_unsigned ? U32 : I32;
    default:
      return is_unsigned ? U64 : I64;
  }
}

bytecode::Opcode binary_opcode(Operator op, Machine machine) {
  // Columns: Bool, I32, I64, F32, F64, U32, U64, Ref. Return marks what the semantic analysis never lets
  // through.
  constexpr Opcode kNone = Opcode::Return;
  struct Row {
    Operator op;
    Opcode opcodes[8];
  };
#define STEPWRIGHT_ROW(op, name)                                                                            \
  {                                                                                                         \
    Operator::op, {                                                                                         \
      kNone, Opcode::name##I32, Opcode::name##I64, Opcode::name##F32, Opcode::name##F64, Opcode::name##U32, \
          Opcode::name##U64, kNone                                                                          \
    }                                                                                                       \
  }
  static constexpr Row kRows[] = {
      {Operator::Or,
       {Opcode::OrBool, Opcode::OrI32, Opcode::OrI64, kNone, kNone, Opcode::OrI32, Opcode::OrI64, kNone}},
      {Operator::Xor,
       {Opcode::XorBool, Opcode::XorI32, Opcode::XorI64, kNone, kNone, Opcode::XorI32, Opcode::XorI64,
        kNone}},
      {Operator::And,
       {Opcode::AndBool, Opcode::AndI32, Opcode::AndI64, kNone, kNone, Opcode::AndI32, Opcode::AndI64,
        kNone}},
      {Operator::Add,
       {kNone, Opcode::AddI32, Opcode::AddI64, Opcode::AddF32, Opcode::AddF64, Opcode::AddI32, Opcode::AddI64,
        kNone}},
      {Operator::Subtract,
       {kNone, Opcode::SubI32, Opcode::SubI64, Opcode::SubF32, Opcode::SubF64, Opcode::SubI32, Opcode::SubI64,
        kNone}},
      {Operator::Multiply,
       {kNone, Opcode::MulI32, Opcode::MulI64, Opcode::MulF32, Opcode::MulF64, Opcode::MulI32, Opcode::MulI64,
        kNone}},
      STEPWRIGHT_ROW(Divide, Div),
      {Operator::Modulo,
       {kNone, Opcode::ModI32, Opcode::ModI64, kNone, kNone, Opcode::ModU32, Opcode::ModU64, kNone}},
      {Operator::Equal,
       {kNone, Opcode::EqI32, Opcode::EqI64, Opcode::EqF32, Opcode::EqF64, Opcode::EqI32, Opcode::EqI64,
        Opcode::EqRef}},
      {Operator::NotEqual,
       {Opcode::XorBool, Opcode::NeI32, Opcode::NeI64, Opcode::NeF32, Opcode::NeF64, Opcode::NeI32,
        Opcode::NeI64, Opcode::NeRef}},
      STEPWRIGHT_ROW(Less, Lt),
      STEPWRIGHT_ROW(LessEqual, Le),
      STEPWRIGHT_ROW(Greater, Gt),
      STEPWRIGHT_ROW(GreaterEqual, Ge),
  };
#undef STEPWRIGHT_ROW
  for (const Row& row : kRows)
    if (row.op == op) return row.opcodes[static_cast<std::size_t>(machine)];
  return kNone;
}

bytecode::IntrinsicId abs_intrinsic(Machine machine) {
  switch (machine) {
    case Machine::F32:
      return IntrinsicId::AbsF32;
    case Machine::F64:
      return IntrinsicId::AbsF64;
    case Machine::I64:
      return IntrinsicId::AbsI64;
    default:
      return IntrinsicId::AbsI32;
  }
}

bytecode::IntrinsicId extremum_intrinsic(bool maximum, Machine machine) {
  using enum IntrinsicId;
  switch (machine) {
    case Machine::F32:
      return maximum ? MaxF32 : MinF32;
    case Machine::F64:
      return maximum ? MaxF64 : MinF64;
    case Machine::I64:
      return maximum ? MaxI64 : MinI64;
    case Machine::U64:
      return maximum ? MaxU64 : MinU64;
    case Machine::U32:
      return maximum ? MaxU32 : MinU32;
    default:
      return maximum ? MaxI32 : MinI32;
  }
}

}  // namespace stepwright::codegen

#include "tests/unit/runtime/native/random_expressions.h"

#include <bit>
#include <iterator>
#include <limits>

namespace stepwright::native {

using bytecode::AddressMode;
using bytecode::IntrinsicId;
using bytecode::IntType;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;

namespace {

constexpr std::int32_t kIntegers[] = {
    0,   1,   2,  3, 7, 8, 31, 32, 33, -1, -2, -128, 127, 32767, 65535, 0x7FFFFFFF, -0x7FFFFFFF - 1,
    255, 256, 64, 63};
constexpr std::int64_t kWide[] = {0,
                                  1,
                                  -1,
                                  5,
                                  1'000'000'007,
                                  0x7FFFFFFF,
                                  0x80000000,
                                  -0x80000000LL,
                                  0xFFFFFFFF,
                                  std::numeric_limits<std::int64_t>::max(),
                                  std::numeric_limits<std::int64_t>::min(),
                                  std::int64_t{1} << 53};
constexpr double kReals[] = {0.0,   -0.0, 0.5,    1.0,   -1.0,    1.5, 2.5,  -2.5,         1e10,   -1e10,
                             1e300, 1e-9, 127.49, 255.5, 65535.5, 0.1, 3e38, 2147483648.0, -129.0, 9.3e18};

Opcode opcode_at(Opcode first, int distance) {
  return static_cast<Opcode>(static_cast<int>(first) + distance);
}

}  // namespace

// The lists of arithmetic opcodes run I32, I64, F32, F64.
Opcode ExpressionWriter::typed(Opcode first, StackType type) const {
  return opcode_at(first, static_cast<int>(type) - static_cast<int>(StackType::I32));
}

MemType ExpressionWriter::memory_type(StackType type) {
  switch (type) {
    case StackType::Bool:
      return MemType::Bool;
    case StackType::I32: {
      static constexpr MemType kTypes[] = {MemType::I8,  MemType::U8,  MemType::I16, MemType::U16,
                                           MemType::I32, MemType::I32, MemType::I32};
      return kTypes[below(std::size(kTypes))];
    }
    case StackType::I64:
      return MemType::I64;
    case StackType::F32:
      return MemType::F32;
    case StackType::F64:
      return MemType::F64;
    case StackType::Ref:
      return MemType::Ref;
  }
  return MemType::I32;
}

// Few places for each type, so that code meets its own variables again; now and then any place at all.
std::uint32_t ExpressionWriter::place(MemType type, std::uint32_t size) {
  const std::uint32_t bytes = size_of(type);
  if (below(24) == 0) return below(size - bytes + 1);
  const std::uint32_t group = type == MemType::I32 ? 0 : 16 + static_cast<std::uint32_t>(type) * 12;
  const std::uint32_t at = group + below(3) * (type == MemType::I32 ? 4 : bytes > 4 ? 4 : bytes);
  return at + bytes <= size ? at : size - bytes;
}

// Where the instance may be written. Counters of loops are mostly left alone.
std::uint32_t ExpressionWriter::own_place(MemType type) {
  const std::uint32_t at = place(type, around_.instance_size);
  return at < 12 && below(10) != 0 ? at + 200 % (around_.instance_size - 20) : at;
}

void ExpressionWriter::push(StackType type, int depth) {
  if (depth <= 0) return leaf(type);
  switch (below(15)) {
    case 0:
    case 1:
      return leaf(type);
    case 12:
      return check(type, depth - 1);
    case 13:
      return elementary(type, depth - 1);
    case 14:
      if (!read_string(type)) leaf(type);
      return;
    case 2:
      return choice(type, depth - 1);
    case 3:
      for (const Callee& callee : around_.callees) {
        if (callee.kind == bytecode::FunctionKind::Function && callee.result == type) return call(callee);
      }
      return leaf(type);
    case 4:
    case 5:
      return conversion(type, depth - 1);
    case 6:
      return intrinsic(type, depth - 1);
    case 7:
      return shift(type, depth - 1);
    default:
      return binary(type, depth - 1);
  }
}

void ExpressionWriter::leaf(StackType type) {
  const std::uint32_t kind = below(6);
  if (kind == 0 && type != StackType::Ref) return constant(type);
  if (kind == 1) {
    for (std::uint32_t i = 0; i < around_.locals.size(); ++i) {
      if (around_.locals[i] == type) return b_.local_get(writer::LocalId(i));
    }
  }
  if (type == StackType::Bool && kind == 2) {
    return b_.load_bit(below(around_.bit_bytes), static_cast<std::uint8_t>(below(8)));
  }
  if (type == StackType::I64 && kind == 3) return b_.emit(Opcode::Now);
  if (type == StackType::Ref && kind == 0 && rash(8)) return b_.emit(Opcode::ConstNull);
  if (type == StackType::Ref && kind != 0) return push_address(16);
  load(type);
}

void ExpressionWriter::load(StackType type) {
  const MemType memory = memory_type(type);
  switch (below(5)) {
    case 0:
      return b_.load(memory, AddressMode::Abs, place(memory, around_.image_size));
    case 1:
      push_address(size_of(memory));
      return b_.load(memory, AddressMode::Ind);
    default:
      if (around_.instance_size == 0) {
        return b_.load(memory, AddressMode::Abs, 64 + place(memory, around_.image_size - 64));
      }
      return b_.load(memory, AddressMode::This, place(memory, around_.instance_size));
  }
}

void ExpressionWriter::constant(StackType type) {
  switch (type) {
    case StackType::Bool:
      return b_.const_bool(below(2) != 0);
    case StackType::I32:
      return b_.const_i32(kIntegers[below(std::size(kIntegers))]);
    case StackType::I64:
      return b_.const_i64(kWide[below(std::size(kWide))]);
    case StackType::F32:
      return b_.const_f32(static_cast<float>(kReals[below(std::size(kReals))]));
    default:
      return b_.const_f64(kReals[below(std::size(kReals))]);
  }
}

void ExpressionWriter::store_variable() {
  const auto type = static_cast<StackType>(below(12) == 0 ? 5 : below(5));
  const MemType memory = memory_type(type);
  push(type, 4);
  if (below(4) == 0 || around_.instance_size == 0) {
    return b_.store(memory, AddressMode::Abs, place(memory, around_.image_size));
  }
  b_.store(memory, AddressMode::This, own_place(memory));
}

// Often a constant or the time.
void ExpressionWriter::store_leaf() {
  const auto type = static_cast<StackType>(below(5));
  const MemType memory = memory_type(type);
  type == StackType::I64 ? b_.emit(Opcode::Now) : leaf(type);
  if (around_.instance_size == 0) {
    return b_.store(memory, AddressMode::Abs, place(memory, around_.image_size));
  }
  b_.store(memory, AddressMode::This, own_place(memory));
}

void ExpressionWriter::call(const Callee& callee) {
  for (const StackType type : callee.parameters) push(type, 1);
  b_.call(callee.index);
}

void ExpressionWriter::choice(StackType type, int depth) {
  if (below(2) == 0) {
    push(type, depth);
    push(type, depth);
    push(StackType::Bool, depth);
    return b_.emit(Opcode::Select);
  }
  const auto otherwise = b_.new_label();
  const auto end = b_.new_label();
  push(StackType::Bool, depth);
  b_.jump_if_false(otherwise);
  push(type, depth);
  b_.jump(end);
  b_.bind(otherwise);
  push(type, depth);
  b_.bind(end);
}

void ExpressionWriter::binary(StackType type, int depth) {
  if (type == StackType::Ref) return push_address(8);
  if (type == StackType::Bool && below(3) != 0) return comparison(depth);
  if (type != StackType::Bool && below(5) == 0) return divide(type, depth);
  if (below(12) == 0) {
    push(type, depth);
    b_.emit(Opcode::Dup);
  } else {
    push(type, depth);
    push(type, depth);
  }
  if (type == StackType::Bool) return b_.emit(opcode_at(Opcode::AndBool, static_cast<int>(below(3))));
  static constexpr Opcode kBits[] = {Opcode::AndI32, Opcode::OrI32, Opcode::XorI32};
  static constexpr Opcode kArithmetic[] = {Opcode::AddI32, Opcode::SubI32, Opcode::MulI32};
  const bool integer = type == StackType::I32 || type == StackType::I64;
  b_.emit(typed(integer && below(3) == 0 ? kBits[below(3)] : kArithmetic[below(3)], type));
}

void ExpressionWriter::divide(StackType type, int depth) {
  push(type, depth);
  push(type, depth);
  const bool guarded = !rash(12);
  if (type == StackType::F32 || type == StackType::F64) {
    if (guarded) {
      const bool wide = type == StackType::F64;
      b_.intrinsic(wide ? IntrinsicId::AbsF64 : IntrinsicId::AbsF32);
      wide ? b_.const_f64(0.5) : b_.const_f32(0.5f);
      b_.intrinsic(wide ? IntrinsicId::MaxF64 : IntrinsicId::MaxF32);
    }
    return b_.emit(type == StackType::F32 ? Opcode::DivF32 : Opcode::DivF64);
  }
  const bool wide = type == StackType::I64;
  if (guarded) {
    wide ? b_.const_i64(1) : b_.const_i32(1);
    b_.emit(wide ? Opcode::OrI64 : Opcode::OrI32);
  }
  static constexpr Opcode kDivisions[] = {Opcode::DivI32, Opcode::DivU32, Opcode::ModI32, Opcode::ModU32};
  b_.emit(opcode_at(kDivisions[below(4)], wide ? 1 : 0));
}

void ExpressionWriter::comparison(int depth) {
  if (below(10) == 0) return compare_references();
  if (below(4) == 0) {
    push(StackType::Bool, depth);
    return b_.emit(Opcode::NotBool);
  }
  const auto type = static_cast<StackType>(1 + below(4));
  push(type, depth);
  push(type, depth);
  static constexpr Opcode kSigned[] = {Opcode::EqI32, Opcode::NeI32, Opcode::LtI32,
                                       Opcode::LeI32, Opcode::GtI32, Opcode::GeI32};
  static constexpr Opcode kUnsigned[] = {Opcode::LtU32, Opcode::LeU32, Opcode::GtU32, Opcode::GeU32};
  const bool integer = type == StackType::I32 || type == StackType::I64;
  if (integer && below(3) == 0) return b_.emit(typed(kUnsigned[below(4)], type));
  b_.emit(typed(kSigned[below(6)], type));
}

void ExpressionWriter::conversion(StackType type, int depth) {
  const std::uint32_t which = below(4);
  switch (type) {
    case StackType::Bool:
      push(which < 2 ? StackType::I32 : StackType::I64, depth);
      return b_.emit(which < 2 ? Opcode::I32ToBool : Opcode::I64ToBool);
    case StackType::I32:
      if (which == 0) {
        push(StackType::Bool, depth);
        return b_.emit(Opcode::BoolToI32);
      }
      if (which == 1) {
        push(StackType::I64, depth);
        return b_.emit(Opcode::I64ToI32);
      }
      if (which == 2 && rash(4)) {
        push(StackType::F64, depth);
        return b_.to_int(below(2) == 0 ? Opcode::RoundF64 : Opcode::TruncF64, static_cast<IntType>(below(6)));
      }
      push(StackType::I32, depth);
      return b_.emit(opcode_at(Opcode::WrapI8, static_cast<int>(below(4))));
    case StackType::I64:
      if (which == 0 && rash(3)) {
        push(StackType::F32, depth);
        return b_.to_int(below(2) == 0 ? Opcode::RoundF32 : Opcode::TruncF32,
                         below(2) == 0 ? IntType::I64 : IntType::U64);
      }
      push(StackType::I32, depth);
      return b_.emit(below(2) == 0 ? Opcode::I32ToI64 : Opcode::U32ToI64);
    case StackType::F32:
      if (which == 0 && rash(2)) {
        push(StackType::F64, depth);
        return b_.emit(Opcode::F64ToF32);
      }
      push(which < 2 ? StackType::I32 : StackType::I64, depth);
      return b_.emit(opcode_at(which < 2 ? Opcode::I32ToF32 : Opcode::I64ToF32, static_cast<int>(below(2))));
    case StackType::F64:
      if (which == 0) {
        push(StackType::F32, depth);
        return b_.emit(Opcode::F32ToF64);
      }
      push(which < 2 ? StackType::I32 : StackType::I64, depth);
      return b_.emit(opcode_at(which < 2 ? Opcode::I32ToF64 : Opcode::I64ToF64, static_cast<int>(below(2))));
    case StackType::Ref:
      return push_address(8);
  }
}

void ExpressionWriter::shift(StackType type, int depth) {
  if (type != StackType::I32 && type != StackType::I64) {
    if (type == StackType::Bool || type == StackType::Ref) return leaf(type);
    push(type, depth);
    return b_.emit(type == StackType::F32 ? Opcode::NegF32 : Opcode::NegF64);
  }
  const bool wide = type == StackType::I64;
  push(type, depth);
  if (below(4) == 0) return b_.emit(typed(below(2) == 0 ? Opcode::NegI32 : Opcode::NotI32, type));
  push(StackType::I32, below(2) == 0 ? 0 : depth);
  const std::uint32_t which = below(4);
  if (which < 2) return b_.emit(opcode_at(which == 0 ? Opcode::ShlI32 : Opcode::ShrI32, wide ? 1 : 0));
  if (wide) return b_.emit(which == 2 ? Opcode::RolI64 : Opcode::RorI64);
  b_.rotate_i32(which == 2 ? Opcode::RolI32 : Opcode::RorI32, static_cast<std::uint8_t>(8u << below(3)));
}

void ExpressionWriter::intrinsic(StackType type, int depth) {
  if (type == StackType::Bool || type == StackType::Ref) return leaf(type);
  push(type, depth);
  const bool floating = type == StackType::F32 || type == StackType::F64;
  const auto at = [&](IntrinsicId first) {
    return static_cast<IntrinsicId>(static_cast<int>(first) + static_cast<int>(type) - 1);
  };
  const std::uint32_t which = below(5);
  if (which == 0) return b_.intrinsic(at(IntrinsicId::AbsI32));
  if (which == 1 && floating) {
    if (!rash(6)) b_.intrinsic(at(IntrinsicId::AbsF32));
    return b_.intrinsic(type == StackType::F32 ? IntrinsicId::SqrtF32 : IntrinsicId::SqrtF64);
  }
  push(type, depth);
  if (floating) {
    const bool wide = type == StackType::F64;
    if (which == 2) return b_.intrinsic(wide ? IntrinsicId::MinF64 : IntrinsicId::MinF32);
    return b_.intrinsic(wide ? IntrinsicId::MaxF64 : IntrinsicId::MaxF32);
  }
  const auto first = which == 2 ? IntrinsicId::MinI32 : IntrinsicId::MaxI32;
  const int distance = static_cast<int>(type) - 1 + (below(2) == 0 ? 2 : 0);
  b_.intrinsic(static_cast<IntrinsicId>(static_cast<int>(first) + distance));
}

}  // namespace stepwright::native

// The parts of ExpressionWriter for strings, subranges, references, dynamic arrays and elementary functions.

#include <cstring>

#include "tests/unit/runtime/native/random_expressions.h"

namespace stepwright::native {

using bytecode::IntrinsicId;
using bytecode::Opcode;
using bytecode::OperationInfo;
using bytecode::StackType;
using bytecode::StringOpId;

namespace {

StackType type_named(char name) {
  constexpr const char* kNames = "bilfdr";
  return static_cast<StackType>(std::strchr(kNames, name) - kNames);
}

}  // namespace

void ExpressionWriter::init_strings() {
  if (around_.frame_size == 0) return;
  for (std::uint32_t i = 0; i < kStrings; ++i) {
    b_.addr_frame(kFrameScalars + i * kStringBytes);
    b_.const_i32(static_cast<std::int32_t>(6 + below(8)));
    b_.string_op(below(4) == 0 ? StringOpId::InitW : StringOpId::InitS);
  }
}

// Mostly a string of the frame, of either width; now and then something that is none.
void ExpressionWriter::push_string() {
  if (around_.frame_size == 0 || rash(12)) return push_address(12);
  b_.addr_frame(kFrameScalars + below(kStrings) * kStringBytes);
}

void ExpressionWriter::string_operands(const OperationInfo& info) {
  for (const char* name = info.pops; *name != '\0'; ++name) {
    const StackType type = type_named(*name);
    if (type == StackType::Ref) {
      push_string();
    } else if (type == StackType::I32) {
      push(StackType::I32, 1);
      if (rash(10)) continue;
      b_.const_i32(7);
      b_.emit(Opcode::AndI32);
    } else {
      push(type, 1);
    }
  }
}

void ExpressionWriter::change_string() {
  // Texts that are read as values come from values, mostly; strings only exist with a frame.
  if (around_.frame_size == 0) return store_variable();
  for (;;) {
    const auto id = static_cast<StringOpId>(below(bytecode::kStringOpCount));
    const OperationInfo& info = bytecode::kStringOps[static_cast<std::uint8_t>(id)];
    if (*info.pushes != '\0') continue;
    const bool picks_character = id == StringOpId::SetCharAtS || id == StringOpId::SetCharAtW;
    if (picks_character && around_.careful) continue;
    string_operands(info);
    return b_.string_op(id);
  }
}

bool ExpressionWriter::read_string(StackType type) {
  if (around_.frame_size == 0) return false;
  for (int attempt = 0; attempt < 20; ++attempt) {
    const std::uint32_t number = below(bytecode::kStringOpCount);
    const OperationInfo& info = bytecode::kStringOps[number];
    if (*info.pushes == '\0' || type_named(*info.pushes) != type) continue;
    const bool may_trap = number != static_cast<std::uint8_t>(StringOpId::LengthS) &&
                          number != static_cast<std::uint8_t>(StringOpId::FindS) &&
                          number != static_cast<std::uint8_t>(StringOpId::CompareS);
    if (may_trap && around_.careful) continue;
    string_operands(info);
    b_.string_op(static_cast<StringOpId>(number));
    return true;
  }
  return false;
}

// Bounds that hold, after a guard, or perhaps not.
void ExpressionWriter::check(StackType type, int depth) {
  if (type != StackType::I32 && type != StackType::I64) return leaf(type);
  push(type, depth);
  const bool guarded = !rash(4);
  if (type == StackType::I32) {
    if (guarded) {
      b_.const_i32(127);
      b_.emit(Opcode::AndI32);
    }
    return b_.check_i32(guarded ? 0 : -5, guarded ? 127 : 1000);
  }
  constexpr std::int64_t kFar = std::int64_t{1} << 40;
  if (guarded) {
    b_.const_i64(kFar - 1);
    b_.emit(Opcode::AndI64);
  }
  if (below(2) == 0) return b_.check_i64(guarded ? 0 : -kFar, kFar);
  b_.check_u64(guarded ? 0 : 3, guarded ? static_cast<std::uint64_t>(kFar) : ~std::uint64_t{0} - 7);
}

void ExpressionWriter::elementary(StackType type, int depth) {
  if (type != StackType::F32 && type != StackType::F64) return leaf(type);
  static constexpr IntrinsicId kSafe[] = {IntrinsicId::SinF32,  IntrinsicId::CosF32, IntrinsicId::TanF32,
                                          IntrinsicId::AtanF32, IntrinsicId::ExpF32, IntrinsicId::Atan2F32};
  static constexpr IntrinsicId kOthers[] = {IntrinsicId::AsinF32, IntrinsicId::AcosF32, IntrinsicId::LnF32,
                                            IntrinsicId::LogF32, IntrinsicId::PowF32};
  const IntrinsicId narrow = rash(3) ? kOthers[below(5)] : kSafe[below(6)];
  const auto number = static_cast<std::uint8_t>(narrow) + (type == StackType::F64 ? 1 : 0);
  push(type, depth);
  if (std::strlen(bytecode::kIntrinsics[number].pops) == 2) push(type, depth);
  b_.intrinsic(static_cast<IntrinsicId>(number));
}

void ExpressionWriter::compare_references() {
  if (below(3) == 0) {
    b_.emit(Opcode::ConstNull);
  } else {
    push_address(4);
  }
  below(2) == 0 ? push(StackType::Ref, 1) : push_address(4);
  b_.emit(below(2) == 0 ? Opcode::EqRef : Opcode::NeRef);
}

// The index and its lower bound are on the stack.
void ExpressionWriter::index_between(std::uint32_t stride) {
  b_.const_i32(static_cast<std::int32_t>(below(3)) + 2);
  b_.index_dyn(stride);
}

}  // namespace stepwright::native

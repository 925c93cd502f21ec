#include "runtime/vm/interpreter.h"

#include <cassert>

#include "runtime/bytecode/stack_need.h"
#include "runtime/vm/arithmetic.h"
#include "runtime/vm/handler_macros.h"
#include "runtime/vm/intrinsics.h"
#include "runtime/vm/memory_access.h"
#include "runtime/vm/reference.h"
#include "runtime/vm/slot.h"
#include "runtime/vm/string_ops.h"

// Computed goto: every handler jumps to the next one itself, which branch predictors like better than one
// shared switch. The families of handlers that differ in type and operator only are in handler_macros.h.

namespace stepwright::vm {

using bytecode::FunctionRecord;
using bytecode::kFrameSlots;
using bytecode::Opcode;
using bytecode::Section;
using bytecode::Trap;
using bytecode::TrapCode;

namespace {

constexpr Slot pack(std::uint32_t high, std::uint64_t low) {
  return (Slot{high} << 32) | static_cast<std::uint32_t>(low);
}

constexpr std::uint32_t operand_bytes(Opcode opcode) {
  return bytecode::size_of(bytecode::info(opcode).operands);
}

}  // namespace

Interpreter::Interpreter(const bytecode::Program& program, std::span<std::uint64_t> stack)
    : program_(program), stack_(stack) {
  assert(stack.size() >= program.sizes().stack_slots);
}

Trap Interpreter::run(const bytecode::Invocation& invocation, std::span<std::byte> memory_block,
                      std::uint64_t& budget) {
  static const void* const kHandlers[] = {
#define STEPWRIGHT_X(name, operands, pops, pushes) &&op_##name,
      STEPWRIGHT_OPCODES(STEPWRIGHT_X)
#undef STEPWRIGHT_X
  };
  assert(memory_block.size() == program_.memory_size());
  const bytecode::ContainerView& view = program_.container();
  const std::byte* const all_code = view.section(Section::Code).data();
  const std::byte* const constants = view.section(Section::Constants).data();
  std::byte* const memory = memory_block.data();
  const std::uint64_t memory_size = memory_block.size();
  Slot* const bottom = stack_.data();
  std::uint64_t budget_left = budget;

  const std::byte* pc = nullptr;
  Slot* sp = bottom;         // the next free slot
  Slot* frame = bottom;      // the running function's locals
  std::byte* self = memory;  // the running instance
  std::uint32_t function = 0;
  TrapCode fault = TrapCode::None;
  std::uint32_t callee = invocation.function;
  std::byte* callee_self = memory + invocation.instance;
  std::uint32_t call_bytes = 0;  // from the call's opcode to the next instruction
  goto enter;

  LOADS(Bool)
  LOADS(I8)
  LOADS(U8)
  LOADS(I16)
  LOADS(U16)
  LOADS(I32)
  LOADS(I64)
  LOADS(F32)
  LOADS(F64)
  LOADS(Ref)
  STORES(Bool)
  STORES(I8)
  STORES(U8)
  STORES(I16)
  STORES(U16)
  STORES(I32)
  STORES(I64)
  STORES(F32)
  STORES(F64)
  STORES(Ref)

op_LoadBit:
  *sp++ = (static_cast<Slot>(memory[OPERAND(std::uint32_t, 0)]) >> OPERAND(std::uint8_t, 4)) & 1;
  DONE(LoadBit);
op_StoreBit : {
  std::byte& cell = memory[OPERAND(std::uint32_t, 0)];
  const auto bit = OPERAND(std::uint8_t, 4);
  cell = (cell & ~(std::byte{1} << bit)) | (static_cast<std::byte>(*--sp) << bit);
  DONE(StoreBit);
}
op_LocalGet:
  *sp++ = frame[OPERAND(std::uint32_t, 0)];
  DONE(LocalGet);
op_LocalSet:
  frame[OPERAND(std::uint32_t, 0)] = *--sp;
  DONE(LocalSet);
op_AddrAbs:
  *sp++ = OPERAND(std::uint32_t, 0);
  DONE(AddrAbs);
op_AddrThis:
  *sp++ = static_cast<Slot>(self - memory) + OPERAND(std::uint32_t, 0);
  DONE(AddrThis);
op_AddrFrame:
  *sp++ = Slot{invocation.frames} + view.record<Section::Functions>(function).frame_offset +
          OPERAND(std::uint32_t, 0);
  DONE(AddrFrame);
op_Index : {
  const std::int64_t index = from_slot<std::int32_t>(sp[-1]);
  const std::int64_t lower = OPERAND(std::int32_t, 0);
  if (index < lower || index > OPERAND(std::int32_t, 4)) FAULT(TrapCode::IndexRange);
  --sp;
  sp[-1] += static_cast<Slot>(index - lower) * OPERAND(std::uint32_t, 8);
  DONE(Index);
}
op_IndexDyn : {
  const std::int64_t index = from_slot<std::int32_t>(sp[-3]);
  const std::int64_t lower = from_slot<std::int32_t>(sp[-2]);
  if (index < lower || index > from_slot<std::int32_t>(sp[-1])) FAULT(TrapCode::IndexRange);
  sp -= 3;
  sp[-1] += static_cast<Slot>(index - lower) * OPERAND(std::uint32_t, 0);
  DONE(IndexDyn);
}
op_Offset:
  sp[-1] += OPERAND(std::uint32_t, 0);
  DONE(Offset);
op_MemCopy : {
  const auto size = OPERAND(std::uint32_t, 0);
  if (!within(sp[-1], size, memory_size)) FAULT(reference_fault(sp[-1]));
  if (!within(sp[-2], size, memory_size)) FAULT(reference_fault(sp[-2]));
  if (size / 16 > budget_left) FAULT(TrapCode::Watchdog);
  budget_left -= size / 16;
  sp -= 2;
  std::memmove(memory + sp[0], memory + sp[1], size);
  DONE(MemCopy);
}

op_StringOp : {
  Slot* top = sp;  // a copy, so that sp itself may live in a register
  std::uint64_t left = budget_left;
  const TrapCode code = call_string_op(OPERAND(bytecode::StringOpId, 0), top, memory_block, left);
  if (code != TrapCode::None) FAULT(code);
  budget_left = left;
  sp = top;
  DONE(StringOp);
}

op_ConstBool:
  *sp++ = OPERAND(std::uint8_t, 0);
  DONE(ConstBool);
op_ConstI32:
op_ConstF32:
  *sp++ = OPERAND(std::uint32_t, 0);
  DONE(ConstI32);
op_ConstI64:
op_ConstF64:
  *sp++ = read_as<Slot>(constants + std::size_t{OPERAND(std::uint32_t, 0)} * sizeof(Slot));
  DONE(ConstI64);

op_ConstNull:
  *sp++ = bytecode::kNullRef;
  NEXT;

  FUSED_BOOLEAN(LoadNotBool, *sp++ = y ^ 1)
  FUSED_BOOLEAN(AndBool, sp[-1] &= y)
  FUSED_BOOLEAN(OrBool, sp[-1] |= y)
  FUSED_BOOLEAN(AndNotBool, sp[-1] &= y ^ 1)
  FUSED_BOOLEAN(OrNotBool, sp[-1] |= y ^ 1)
  FUSED_BOOLEAN(XorBool, sp[-1] ^= y)

  ARITHMETIC(Add, +)
  ARITHMETIC(Sub, -)
  ARITHMETIC(Mul, *)
  DIVISION(DivI32, std::int32_t, divide(x, y))
  DIVISION(DivI64, std::int64_t, divide(x, y))
  DIVISION(DivU32, std::uint32_t, divide(x, y))
  DIVISION(DivU64, std::uint64_t, divide(x, y))
  DIVISION(DivF32, float, x / y)
  DIVISION(DivF64, double, x / y)
  BINARY(ModI32, std::int32_t, modulo(x, y))
  BINARY(ModI64, std::int64_t, modulo(x, y))
  BINARY(ModU32, std::uint32_t, modulo(x, y))
  BINARY(ModU64, std::uint64_t, modulo(x, y))
  UNARY(NegI32, std::uint32_t, negate(x))
  UNARY(NegI64, std::uint64_t, negate(x))
  UNARY(NegF32, float, -x)
  UNARY(NegF64, double, -x)
  UNARY(WrapI8, std::int32_t, std::int32_t{static_cast<std::int8_t>(x)})
  UNARY(WrapU8, std::uint32_t, x & 0xFFu)
  UNARY(WrapI16, std::int32_t, std::int32_t{static_cast<std::int16_t>(x)})
  UNARY(WrapU16, std::uint32_t, x & 0xFFFFu)

  BITWISE(And, &)
  BITWISE(Or, |)
  BITWISE(Xor, ^)
  UNARY(NotBool, std::uint64_t, x ^ 1u)
  UNARY(NotI32, std::uint32_t, ~x)
  UNARY(NotI64, std::uint64_t, ~x)
  SHIFT(ShlI32, std::uint32_t, shift_left(x, count))
  SHIFT(ShlI64, std::uint64_t, shift_left(x, count))
  SHIFT(ShrI32, std::uint32_t, shift_right(x, count))
  SHIFT(ShrI64, std::uint64_t, shift_right(x, count))
  SHIFT(RolI32, std::uint32_t, rotate_left(x, count, OPERAND(std::uint8_t, 0)))
  SHIFT(RolI64, std::uint64_t, std::rotl(x, static_cast<int>(count & 63)))
  SHIFT(RorI32, std::uint32_t, rotate_right(x, count, OPERAND(std::uint8_t, 0)))
  SHIFT(RorI64, std::uint64_t, std::rotr(x, static_cast<int>(count & 63)))

  COMPARISONS(Eq, ==)
  COMPARISONS(Ne, !=)
  ORDERED(Lt, <)
  ORDERED(Le, <=)
  ORDERED(Gt, >)
  ORDERED(Ge, >=)
  BINARY(EqRef, std::uint64_t, x == y)
  BINARY(NeRef, std::uint64_t, x != y)
  CHECK(CheckI32, std::int32_t, OPERAND(std::int32_t, 0), OPERAND(std::int32_t, 4))
  CHECK(CheckI64, std::int64_t, CONSTANT(std::int64_t, 0), CONSTANT(std::int64_t, 4))
  CHECK(CheckU64, std::uint64_t, CONSTANT(std::uint64_t, 0), CONSTANT(std::uint64_t, 4))

  UNARY(I32ToBool, std::uint32_t, x != 0)
  UNARY(I64ToBool, std::uint64_t, x != 0)
  UNARY(I32ToI64, std::int32_t, std::int64_t{x})
  UNARY(I64ToI32, std::uint64_t, static_cast<std::uint32_t>(x))
  UNARY(I32ToF32, std::int32_t, static_cast<float>(x))
  UNARY(U32ToF32, std::uint32_t, static_cast<float>(x))
  UNARY(I64ToF32, std::int64_t, static_cast<float>(x))
  UNARY(U64ToF32, std::uint64_t, static_cast<float>(x))
  UNARY(I32ToF64, std::int32_t, static_cast<double>(x))
  UNARY(U32ToF64, std::uint32_t, static_cast<double>(x))
  UNARY(I64ToF64, std::int64_t, static_cast<double>(x))
  UNARY(U64ToF64, std::uint64_t, static_cast<double>(x))
  UNARY(F32ToF64, float, static_cast<double>(x))
op_F64ToF32 : {
  const auto wide = from_slot<double>(sp[-1]);
  const auto narrow = static_cast<float>(wide);
  if (is_infinite(narrow) && !is_infinite(wide)) FAULT(TrapCode::ConversionRange);
  sp[-1] = to_slot(narrow);
  NEXT;
}
  TO_INTEGER(RoundF32, float, round_to_even)
  TO_INTEGER(RoundF64, double, round_to_even)
  TO_INTEGER(TruncF32, float, truncate)
  TO_INTEGER(TruncF64, double, truncate)
op_BoolToI32:  // the slots of FALSE and TRUE are those of 0 and 1,
op_U32ToI64:   // and the high half of an I32 slot is zero
  NEXT;

op_Dup:
  *sp = sp[-1];
  ++sp;
  NEXT;
op_Drop:
  --sp;
  NEXT;
op_Select : {
  const Slot mask = Slot{0} - sp[-1];
  sp -= 2;
  sp[-1] = (sp[0] & mask) | (sp[-1] & ~mask);
  NEXT;
}
op_Jump:
  JUMP(Jump, true)
op_JumpIfFalse:
  --sp;
  JUMP(JumpIfFalse, *sp == 0)
op_JumpIfTrue:
  --sp;
  JUMP(JumpIfTrue, *sp != 0)

op_Call:
  callee = OPERAND(std::uint32_t, 0);
  callee_self = self;
  call_bytes = bytecode::instruction_size(Opcode::Call);
  goto enter;
op_CallInstanceAbs:
  callee = OPERAND(std::uint32_t, 0);
  callee_self = memory + OPERAND(std::uint32_t, 4);
  call_bytes = bytecode::instruction_size(Opcode::CallInstanceAbs);
  goto enter;
op_CallInstanceThis:
  callee = OPERAND(std::uint32_t, 0);
  callee_self = self + OPERAND(std::uint32_t, 4);
  call_bytes = bytecode::instruction_size(Opcode::CallInstanceThis);
  goto enter;
op_CallInstanceInd : {
  callee = OPERAND(std::uint32_t, 0);
  const FunctionRecord target = view.record<Section::Functions>(callee);
  if (!within(sp[-1], target.instance_size, memory_size)) FAULT(reference_fault(sp[-1]));
  callee_self = memory + *--sp;
  call_bytes = bytecode::instruction_size(Opcode::CallInstanceInd);
  goto enter;
}

// Starts `callee` on `callee_self`; its parameters are on top of the stack and become its first locals.
enter : {
  const FunctionRecord target = view.record<Section::Functions>(callee);
  if (target.code_size > budget_left) {
    // The caller's instruction is at fault, or the callee where there is no caller.
    if (pc == nullptr) {
      budget = budget_left;
      return {TrapCode::Watchdog, callee, 0};
    }
    FAULT(TrapCode::Watchdog);
  }
  budget_left -= target.code_size;
  Slot* const locals = sp - target.param_count;
  Slot* const operands = locals + target.local_count + kFrameSlots;
  for (; sp < operands - kFrameSlots; ++sp) *sp = 0;
  if (pc != nullptr) {
    const FunctionRecord caller = view.record<Section::Functions>(function);
    const std::byte* const resume = pc - 1 + call_bytes;
    operands[-2] = pack(function, static_cast<std::uint64_t>(resume - (all_code + caller.code_offset)));
    operands[-1] =
        pack(static_cast<std::uint32_t>(self - memory), static_cast<std::uint64_t>(frame - bottom));
  }
  sp = operands;
  frame = locals;
  self = callee_self;
  function = callee;
  pc = all_code + target.code_offset;
  NEXT;
}

op_Return : {
  const FunctionRecord leaving = view.record<Section::Functions>(function);
  if (frame == bottom) {
    budget = budget_left;
    return {};
  }
  const Slot* const saved = frame + leaving.local_count;
  const Slot where = saved[0];
  const Slot context = saved[1];
  const Slot result = sp[-1];
  sp = frame;
  *sp = result;
  sp += leaving.result != bytecode::kNoResult ? 1 : 0;
  function = static_cast<std::uint32_t>(where >> 32);
  pc = all_code + view.record<Section::Functions>(function).code_offset + static_cast<std::uint32_t>(where);
  self = memory + (context >> 32);
  frame = bottom + static_cast<std::uint32_t>(context);
  NEXT;
}
op_Now:
  *sp++ = to_slot(invocation.now_ns);
  NEXT;
op_Intrinsic : {
  Slot* top = sp;
  if (!call_intrinsic(OPERAND(bytecode::IntrinsicId, 0), top)) FAULT(TrapCode::BadArgument);
  sp = top;
  DONE(Intrinsic);
}
op_Trap:
  FAULT(OPERAND(TrapCode, 0));

trapped:
  budget = budget_left;
  const FunctionRecord at_fault = view.record<Section::Functions>(function);
  return {fault, function, static_cast<std::uint32_t>(pc - (all_code + at_fault.code_offset))};
}

}  // namespace stepwright::vm

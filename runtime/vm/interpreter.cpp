#include "runtime/vm/interpreter.h"

#include <cassert>

#include "runtime/bytecode/stack_need.h"
#include "runtime/operations/arithmetic.h"
#include "runtime/operations/intrinsics.h"
#include "runtime/operations/memory_access.h"
#include "runtime/operations/reference.h"
#include "runtime/operations/slot.h"
#include "runtime/operations/string_ops.h"
#include "runtime/vm/handler_macros.h"
#include "runtime/vm/super_handlers.h"
#include "runtime/vm/superinstruction.h"

// Computed goto: every handler jumps to the next one itself, which branch predictors like better than one
// shared switch. The families of handlers that differ in type and operator only are in handler_macros.h, the
// superinstructions in super_handlers.h.

namespace stepwright::vm {

using namespace operations;  // what the instructions mean

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

// Where the operands of each part lie behind the number of the superinstruction; at `count`: its end.
constexpr std::array<std::uint32_t, kMostParts + 1> part_offsets(const Superinstruction& super) {
  std::array<std::uint32_t, kMostParts + 1> offsets{};
  for (std::uint32_t part = 0; part <= super.count; ++part) offsets[part] = super.offset(part);
  return offsets;
}

}  // namespace

Interpreter::Interpreter(const bytecode::Program& program, std::span<std::uint64_t> stack)
    : program_(program), stack_(stack), code_(program.container().section(Section::Code)) {
  assert(stack.size() >= program.sizes().stack_slots);
}

#ifndef STEPWRIGHT_PLAIN_INTERPRETER
Interpreter::Interpreter(const bytecode::Program& program, std::span<std::uint64_t> stack,
                         std::span<std::byte> quick_code)
    : Interpreter(program, stack) {
  quicken(program, quick_code);
  code_ = quick_code;
}
#endif

Trap Interpreter::run(const bytecode::Invocation& invocation, std::span<std::byte> memory_block,
                      std::uint64_t& budget) {
  static const void* const kHandlers[] = {
#define STEPWRIGHT_X(name, operands, pops, pushes) &&op_##name,
      STEPWRIGHT_OPCODES(STEPWRIGHT_X)
#undef STEPWRIGHT_X
  };
#ifndef STEPWRIGHT_PLAIN_INTERPRETER
  static const void* const kQuickHandlers[] = {
#define STEPWRIGHT_X(name, ...) &&op_##name,
      STEPWRIGHT_QUICK_ORIGINALS(STEPWRIGHT_X)
#undef STEPWRIGHT_X
#define STEPWRIGHT_X(name, ...) &&super_##name,
          STEPWRIGHT_SUPERINSTRUCTIONS(STEPWRIGHT_X)
#undef STEPWRIGHT_X
      && original};
#endif
  assert(memory_block.size() == program_.memory_size());
  const bytecode::ContainerView& view = program_.container();
  [[maybe_unused]] const std::byte* const file_code = view.section(Section::Code).data();
  const std::byte* const all_code = code_.data();
#ifndef STEPWRIGHT_PLAIN_INTERPRETER
  const void* const* handlers = all_code == file_code ? kHandlers : kQuickHandlers;
#else
  const void* const* handlers = kHandlers;
#endif
  // The compiler forgets what it knows of the address, so that it keeps it in a register for all handlers.
  asm("" : "+r"(handlers));
  const std::byte* const constants = view.section(Section::Constants).data();
  const std::byte* const functions = view.section(Section::Functions).data();
  std::byte* const memory = memory_block.data();
  const std::uint64_t memory_size = memory_block.size();
  Slot* const bottom = stack_.data();
  bytecode::BudgetSlices slices{0, interrupt_};
  std::uint64_t budget_left = bytecode::BudgetSlices::first(budget, interrupt_);
  slices.reserve = budget - budget_left;

  std::uint32_t function = invocation.function;
  const std::byte* pc = all_code + FUNCTION(function, code_offset);
  Slot* frame = bottom;                                 // the running function's locals
  Slot* sp = bottom + FUNCTION(function, local_count);  // where the top of the stack lies, once it is stored
  Slot top = 0;                                         // the top of the stack
  std::byte* self = memory + invocation.instance;       // the running instance
  TrapCode fault = TrapCode::None;
  std::uint32_t callee = 0;
  std::byte* callee_self = nullptr;
  const std::byte* resume = nullptr;  // where the caller goes on
  if (FUNCTION(function, code_size) > budget_left)
    budget_left = slices.refill(budget_left, FUNCTION(function, code_size));
  if (FUNCTION(function, code_size) > budget_left) return {TrapCode::Watchdog, function, 0};
  budget_left -= FUNCTION(function, code_size);
  for (Slot* local = bottom; local < sp; ++local) *local = 0;
  sp += kFrameSlots - 1;
  NEXT;

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
  PUSH((static_cast<Slot>(memory[OPERAND(std::uint32_t, 0)]) >> OPERAND(std::uint8_t, 4)) & 1);
  DONE(LoadBit);
op_StoreBit : {
  std::byte& cell = memory[OPERAND(std::uint32_t, 0)];
  const auto bit = OPERAND(std::uint8_t, 4);
  cell = (cell & ~(std::byte{1} << bit)) | (static_cast<std::byte>(top) << bit);
  POP();
  DONE(StoreBit);
}
op_LocalGet:
  PUSH(frame[OPERAND(std::uint32_t, 0)]);
  DONE(LocalGet);
op_LocalSet:
  frame[OPERAND(std::uint32_t, 0)] = top;
  POP();
  DONE(LocalSet);
op_AddrAbs:
  PUSH(OPERAND(std::uint32_t, 0));
  DONE(AddrAbs);
op_AddrThis:
  PUSH(static_cast<Slot>(self - memory) + OPERAND(std::uint32_t, 0));
  DONE(AddrThis);
op_AddrFrame:
  PUSH(Slot{invocation.frames} + FUNCTION(function, frame_offset) + OPERAND(std::uint32_t, 0));
  DONE(AddrFrame);
op_Index : {
  const std::int64_t index = from_slot<std::int32_t>(top);
  const std::int64_t lower = OPERAND(std::int32_t, 0);
  if (index < lower || index > OPERAND(std::int32_t, 4)) FAULT(TrapCode::IndexRange);
  top = *--sp + static_cast<Slot>(index - lower) * OPERAND(std::uint32_t, 8);
  DONE(Index);
}
op_IndexDyn : {
  const std::int64_t index = from_slot<std::int32_t>(sp[-2]);
  const std::int64_t lower = from_slot<std::int32_t>(sp[-1]);
  if (index < lower || index > from_slot<std::int32_t>(top)) FAULT(TrapCode::IndexRange);
  sp -= 3;
  top = *sp + static_cast<Slot>(index - lower) * OPERAND(std::uint32_t, 0);
  DONE(IndexDyn);
}
op_Offset:
  top += OPERAND(std::uint32_t, 0);
  DONE(Offset);
op_MemCopy : {
  const auto size = OPERAND(std::uint32_t, 0);
  if (!within(top, size, memory_size)) FAULT(reference_fault(top));
  if (!within(sp[-1], size, memory_size)) FAULT(reference_fault(sp[-1]));
  CHARGE(size / 16, FAULT(TrapCode::Watchdog));
  std::memmove(memory + sp[-1], memory + top, size);
  --sp;
  POP();
  DONE(MemCopy);
}

op_StringOp : {
  *sp = top;
  Slot* free = sp + 1;  // copies, so that sp and the budget may live in registers
  std::uint64_t left = budget_left + slices.reserve;
  const TrapCode code = call_string_op(OPERAND(bytecode::StringOpId, 0), free, memory_block, left);
  if (code != TrapCode::None) FAULT(code);
  budget_left = slices.after(budget_left, left);
  sp = free;
  POP();
  DONE(StringOp);
}

op_ConstBool:
  PUSH(OPERAND(std::uint8_t, 0));
  DONE(ConstBool);
op_ConstI32:
op_ConstF32:
  PUSH(OPERAND(std::uint32_t, 0));
  DONE(ConstI32);
op_ConstI64:
op_ConstF64:
  PUSH(read_as<Slot>(constants + std::size_t{OPERAND(std::uint32_t, 0)} * sizeof(Slot)));
  DONE(ConstI64);

op_ConstNull:
  PUSH(bytecode::kNullRef);
  NEXT;

  FUSED_BOOLEAN(LoadNotBool, PUSH(y ^ 1))
  FUSED_BOOLEAN(AndBool, top &= y)
  FUSED_BOOLEAN(OrBool, top |= y)
  FUSED_BOOLEAN(AndNotBool, top &= y ^ 1)
  FUSED_BOOLEAN(OrNotBool, top |= y ^ 1)
  FUSED_BOOLEAN(XorBool, top ^= y)
  FUSED_PAIR(FUSED_LOAD, LoadAndBool, x & y)
  FUSED_PAIR(FUSED_LOAD, LoadOrBool, x | y)
  FUSED_PAIR(FUSED_LOAD, LoadAndNotBool, x & (y ^ 1))
  FUSED_PAIR(FUSED_LOAD, LoadOrNotBool, x | (y ^ 1))
  FUSED_PAIR(FUSED_LOAD, LoadNorBool, (x | y) ^ 1)
  FUSED_PAIR(FUSED_LOAD, LoadNandBool, (x & y) ^ 1)
  FUSED_PAIR(FUSED_STORE, AndStoreBool, top & y)
  FUSED_PAIR(FUSED_STORE, OrStoreBool, top | y)
  FUSED_PAIR(FUSED_STORE, AndNotStoreBool, top & (y ^ 1))
  FUSED_PAIR(FUSED_STORE, OrNotStoreBool, top | (y ^ 1))
  FUSED_PAIR(FUSED_MOVE, MoveBool, y)
  FUSED_PAIR(FUSED_MOVE, MoveNotBool, y ^ 1)

  ARITHMETIC(Add, +)
  ARITHMETIC(Sub, -)
  ARITHMETIC(Mul, *)
  DIVISION(DivI32, std::int32_t, divide(x, y))
  DIVISION(DivI64, std::int64_t, divide(x, y))
  DIVISION(DivU32, std::uint32_t, divide(x, y))
  DIVISION(DivU64, std::uint64_t, divide(x, y))
  DIVISION(DivF32, float, settle_nan<float>(x / y, x, y))
  DIVISION(DivF64, double, settle_nan<double>(x / y, x, y))
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
  const auto wide = from_slot<double>(top);
  const auto narrow = static_cast<float>(wide);
  if (is_infinite(narrow) && !is_infinite(wide)) FAULT(TrapCode::ConversionRange);
  top = to_slot(narrow);
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
  *sp++ = top;
  NEXT;
op_Drop:
  POP();
  NEXT;
op_Select : {
  const Slot mask = Slot{0} - top;
  sp -= 2;
  top = (sp[1] & mask) | (sp[0] & ~mask);
  NEXT;
}
op_Jump:
  JUMP(Jump, true)
op_JumpIfFalse : {
  const Slot condition = top;
  POP();
  JUMP(JumpIfFalse, condition == 0)
}
op_JumpIfTrue : {
  const Slot condition = top;
  POP();
  JUMP(JumpIfTrue, condition != 0)
}

op_Call:
  callee = OPERAND(std::uint32_t, 0);
  callee_self = self;
  resume = pc + operand_bytes(Opcode::Call);
  goto call;
op_CallInstanceAbs:
  callee = OPERAND(std::uint32_t, 0);
  callee_self = memory + OPERAND(std::uint32_t, 4);
  resume = pc + operand_bytes(Opcode::CallInstanceAbs);
  goto call;
op_CallInstanceThis:
  callee = OPERAND(std::uint32_t, 0);
  callee_self = self + OPERAND(std::uint32_t, 4);
  resume = pc + operand_bytes(Opcode::CallInstanceThis);
  goto call;
op_CallInstanceInd:
  callee = OPERAND(std::uint32_t, 0);
  if (!within(top, FUNCTION(callee, instance_size), memory_size)) FAULT(reference_fault(top));
  callee_self = memory + top;
  POP();
  resume = pc + operand_bytes(Opcode::CallInstanceInd);
  goto call;

// Starts `callee` on `callee_self`; its parameters are on top of the stack and become its first locals.
call : {
  const std::uint32_t code_size = FUNCTION(callee, code_size);
  CHARGE(code_size, FAULT(TrapCode::Watchdog));
  *sp++ = top;
  Slot* const locals = sp - FUNCTION(callee, param_count);
  Slot* const saved = locals + FUNCTION(callee, local_count);
  for (; sp < saved; ++sp) *sp = 0;
  saved[0] = pack(function, static_cast<std::uint64_t>(resume - all_code));
  saved[1] = pack(static_cast<std::uint32_t>(self - memory), static_cast<std::uint64_t>(frame - bottom));
  sp = saved + kFrameSlots - 1;
  frame = locals;
  self = callee_self;
  function = callee;
  pc = all_code + FUNCTION(callee, code_offset);
  NEXT;
}

// The stack holds the result at most.
op_Return : {
  if (frame == bottom) {
    budget = budget_left + slices.reserve;
    return {};
  }
  const bool gives_result = FUNCTION(function, result) != bytecode::kNoResult;
  const Slot* const saved = sp - (gives_result ? 1 : 0) - (kFrameSlots - 1);
  const Slot where = saved[0];
  const Slot context = saved[1];
  sp = frame;
  if (!gives_result) POP();
  function = static_cast<std::uint32_t>(where >> 32);
  pc = all_code + static_cast<std::uint32_t>(where);
  self = memory + (context >> 32);
  frame = bottom + static_cast<std::uint32_t>(context);
  NEXT;
}
op_Now:
  PUSH(to_slot(invocation.now_ns));
  NEXT;
op_Intrinsic : {
  *sp = top;
  Slot* free = sp + 1;
  if (!call_intrinsic(OPERAND(bytecode::IntrinsicId, 0), free)) FAULT(TrapCode::BadArgument);
  sp = free;
  POP();
  DONE(Intrinsic);
}
op_Trap:
  FAULT(OPERAND(TrapCode, 0));

#ifndef STEPWRIGHT_PLAIN_INTERPRETER
  SUPER_HANDLERS

original:
  goto* kHandlers[static_cast<std::uint8_t>(file_code[pc - 1 - all_code])];
#endif

trapped : {
  budget = budget_left + slices.reserve;
  Trap trap{fault, function, static_cast<std::uint32_t>(pc - (all_code + FUNCTION(function, code_offset)))};
  // Back to the call that led out of what the user wrote.
  while ((FUNCTION(function, flags) & bytecode::kFunctionOfLibrary) != 0 && frame != bottom) {
    const Slot* const saved = frame + FUNCTION(function, local_count);
    function = static_cast<std::uint32_t>(saved[0] >> 32);
    frame = bottom + static_cast<std::uint32_t>(saved[1]);
    trap.caller = function;
    trap.return_pc = static_cast<std::uint32_t>(saved[0]) - FUNCTION(function, code_offset);
  }
  return trap;
}
}

}  // namespace stepwright::vm

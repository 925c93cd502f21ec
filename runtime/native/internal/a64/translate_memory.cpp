#include <bit>

#include "runtime/native/internal/a64/translate.h"

namespace stepwright::native::a64 {

using bytecode::AddressMode;
using bytecode::Instruction;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;

namespace {

bool is_real(MemType type) {
  return type == MemType::F32 || type == MemType::F64;
}

void load(FunctionWork& work, const MemoryAccess& access, std::uint32_t offset) {
  Operands& operands = work.operands();
  const std::uint32_t bytes = size_of(access.type);
  const bool plain = access.type != MemType::Bool || work.reads_plain_bool();
  if (access.mode == AddressMode::Ind) {
    const RegisterId reference = operands.pop_register();
    check_reference(work, reference, bytes);
    const RegisterId to = is_real(access.type) ? operands.allocate(true) : reference;
    work.emit().load(to, access.type, ptr(kImage, x(reference)), plain);
    if (to != reference) operands.release(reference);
    return operands.push_register(stack_type(access.type), to);
  }
  const RegisterId to = operands.allocate(is_real(access.type));
  const Mem from =
      access.mode == AddressMode::Abs ? work.absolute(offset, bytes) : work.of_self(offset, bytes);
  work.emit().load(to, access.type, from, plain);
  operands.push_register(stack_type(access.type), to);
}

void store(FunctionWork& work, const MemoryAccess& access, std::uint32_t offset) {
  Operands& operands = work.operands();
  const std::uint32_t bytes = size_of(access.type);
  const RegisterId value = operands.pop_register();
  if (access.mode == AddressMode::Ind) {
    const RegisterId reference = operands.pop_register();
    check_reference(work, reference, bytes);
    work.emit().store(ptr(kImage, x(reference)), access.type, value);
    operands.release(reference);
  } else {
    const Mem to =
        access.mode == AddressMode::Abs ? work.absolute(offset, bytes) : work.of_self(offset, bytes);
    work.emit().store(to, access.type, value);
  }
  operands.release(value);
}

void load_bit(FunctionWork& work, const Instruction& in) {
  const RegisterId to = work.operands().allocate(false);
  work.out().ldrb(w(to), work.absolute(in.a, 1));
  if (in.b != 0) work.out().lsr(w(to), w(to), in.b);
  work.out().and_(w(to), w(to), 1);
  work.operands().push_register(StackType::Bool, to);
}

void store_bit(FunctionWork& work, const Instruction& in) {
  Operands& operands = work.operands();
  const RegisterId value = operands.pop_register();
  const Mem byte = work.absolute(in.a, 1);
  work.out().ldrb(w(kScratch), byte);
  work.out().bfi(w(kScratch), w(value), in.b, 1);
  work.out().strb(w(kScratch), byte);
  operands.release(value);
}

void local_get(FunctionWork& work, std::uint32_t index) {
  const StackType type = work.view().local_type(work.code().record, index);
  const RegisterId to = work.operands().allocate(is_float(type));
  work.emit().load_slot(to, work.local(index));
  work.operands().push_register(type, to);
}

void local_set(FunctionWork& work, std::uint32_t index) {
  const RegisterId value = work.operands().pop_register();
  work.emit().store_slot(work.local(index), value);
  work.operands().release(value);
}

void address(FunctionWork& work, const GpX& base, std::uint32_t offset) {
  Operands& operands = work.operands();
  const RegisterId to = operands.allocate(false);
  work.out().sub(x(to), base, kImage);
  work.emit().add(x(to), x(to), offset);
  operands.push_register(StackType::Ref, to);
}

void address_of_frame(FunctionWork& work, std::uint32_t offset) {
  Operands& operands = work.operands();
  const RegisterId to = operands.allocate(false);
  work.out().ldr(x(to), work.field(offsetof(Context, frames)));
  work.emit().add(x(to), x(to), std::uint64_t{work.code().record.frame_offset} + offset);
  operands.push_register(StackType::Ref, to);
}

// reference + number * stride; the number's high half is zero.
void add_elements(FunctionWork& work, RegisterId reference, RegisterId number, std::uint32_t stride) {
  Assembler& out = work.out();
  if (std::has_single_bit(stride)) {
    out.add(x(reference), x(reference), x(number), asmjit::arm::lsl(std::countr_zero(stride)));
  } else if (stride != 0) {
    work.emit().constant(x(kAddress), stride);
    out.madd(x(reference), x(number), x(kAddress), x(reference));
  }
}

void index(FunctionWork& work, const Instruction& in) {
  Operands& operands = work.operands();
  const RegisterId number = operands.pop_register();
  const RegisterId reference = operands.pop_register();
  if (in.a != 0) {
    work.emit().constant(w(kScratch), in.a);
    work.out().sub(w(number), w(number), w(kScratch));
  }
  work.emit().compare(w(number), in.b - in.a);
  work.emit().branch(CondCode::kHI, work.trap(TrapCode::IndexRange));
  add_elements(work, reference, number, in.c);
  operands.release(number);
  operands.push_register(StackType::Ref, reference);
}

// Base, index, lower and upper bound, all known only when the program runs.
void index_between(FunctionWork& work, std::uint32_t stride) {
  Operands& operands = work.operands();
  const RegisterId upper = operands.pop_register();
  const RegisterId lower = operands.pop_register();
  const RegisterId number = operands.pop_register();
  const RegisterId reference = operands.pop_register();
  const asmjit::Label outside = work.trap(TrapCode::IndexRange);
  work.out().cmp(w(number), w(upper));
  work.emit().branch(CondCode::kGT, outside);
  work.out().cmp(w(number), w(lower));
  work.emit().branch(CondCode::kLT, outside);
  work.out().sub(w(number), w(number), w(lower));
  add_elements(work, reference, number, stride);
  operands.release(upper);
  operands.release(lower);
  operands.release(number);
  operands.push_register(StackType::Ref, reference);
}

void offset(FunctionWork& work, std::uint32_t bytes) {
  const RegisterId reference = work.operands().pop_register();
  work.emit().add(x(reference), x(reference), bytes);
  work.operands().push_register(StackType::Ref, reference);
}

}  // namespace

void check_reference(FunctionWork& work, RegisterId reference, std::uint32_t bytes) {
  if (bytes > work.memory_size()) {
    work.out().b(work.reference_trap(reference));
    return;
  }
  work.emit().compare(x(reference), work.memory_size() - bytes);
  work.emit().branch(CondCode::kHI, work.reference_trap(reference));
}

bool translate_memory(FunctionWork& work, const Instruction& in) {
  if (is_memory_access(in.opcode)) {
    const MemoryAccess access = memory_access(in.opcode);
    access.store ? store(work, access, in.a) : load(work, access, in.a);
    return true;
  }
  switch (in.opcode) {
    case Opcode::LoadBit:
      return load_bit(work, in), true;
    case Opcode::StoreBit:
      return store_bit(work, in), true;
    case Opcode::LocalGet:
      return local_get(work, in.a), true;
    case Opcode::LocalSet:
      return local_set(work, in.a), true;
    case Opcode::AddrAbs:
      return work.operands().push_constant(StackType::Ref, in.a), true;
    case Opcode::AddrThis:
      return address(work, kSelf, in.a), true;
    case Opcode::AddrFrame:
      return address_of_frame(work, in.a), true;
    case Opcode::Index:
      return index(work, in), true;
    case Opcode::IndexDyn:
      return index_between(work, in.a), true;
    case Opcode::Offset:
      return offset(work, in.a), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native::a64

#include <limits>

#include "runtime/native/internal/x86/effect_check.h"
#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using bytecode::AddressMode;
using bytecode::Instruction;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;
namespace x86 = asmjit::x86;

namespace {

// Offsets of memory operands are signed 32-bit numbers.
constexpr std::uint64_t kFarthestOperand = 0x7FFF0000;

void load(FunctionWork& work, MemoryAccess access, const Instruction& in) {
  const MemoryEffect& effect = work.effect(false);
  Location from;
  if (access.mode == AddressMode::Ind) {
    Value address = work.operands().pop_settled();
    from = place_at(work, address, effect, size_of(access.type));
  } else {
    from = access.mode == AddressMode::Abs ? work.absolute(in.a) : work.of_self(in.a);
  }
  push_load(work, from, effect, stack_type(access.type));
}

void store_access(FunctionWork& work, MemoryAccess access, const Instruction& in) {
  Operands& operands = work.operands();
  const MemoryEffect& effect = work.effect(true);
  Value value = operands.pop_settled_beside_flags();
  if (access.mode != AddressMode::Ind) {
    const bool absolute = access.mode == AddressMode::Abs;
    return store(work, absolute ? work.absolute(in.a) : work.of_self(in.a), effect, value);
  }
  Value address = operands.pop_settled_beside_flags();
  const Location to = place_at(work, address, effect, size_of(access.type));
  store(work, to, effect, value);
  operands.release(address);
}

void load_bit(FunctionWork& work, const Instruction& in) {
  check_access(work, work.absolute(in.a), work.effect(false), 1);
  Value value = Value::of_load(MemType::Bool, work.absolute(in.a), work.effect(false).extent);
  value.bit = static_cast<std::uint8_t>(in.b);
  work.operands().push(value);
}

void store_bit(FunctionWork& work, const Instruction& in) {
  Operands& operands = work.operands();
  Value value = operands.pop_settled();
  const Location to = work.absolute(in.a);
  check_access(work, to, work.effect(true), 1);
  operands.before_write(work.effect(true).extent);
  operands.settle_flags();
  const x86::Mem byte = operands.memory(to, 1);
  const auto mask = static_cast<std::int32_t>(1u << in.b);
  if (value.is(Value::Kind::Constant)) {
    value.constant != 0 ? work.out().or_(byte, mask) : work.out().and_(byte, 0xFF & ~mask);
    return;
  }
  // The bit is cleared and the value set into it; the byte is written once.
  const RegisterId reg = operands.in_own_register(value);
  work.out().movzx(gp32(kScratch), byte);
  work.out().and_(gp32(kScratch), 0xFF & ~mask);
  if (in.b != 0) work.out().shl(gp8(reg), in.b);
  work.out().or_(gp8(kScratch), gp8(reg));
  work.out().mov(byte, gp8(kScratch));
  operands.release(value);
}

void offset(FunctionWork& work, std::uint32_t bytes) {
  Operands& operands = work.operands();
  Value base = operands.pop_settled();
  if (base.is(Value::Kind::Address) && base.location.offset + bytes <= kFarthestOperand) {
    base.location.offset += bytes;
  } else if (bytes != 0) {
    operands.settle_flags();
    const RegisterId reg = operands.in_own_register(base);
    work.out().add(gp64(reg), bytes);
  }
  operands.push(base);
}

bool scalable(std::uint32_t stride) {
  return stride == 1 || stride == 2 || stride == 4 || stride == 8;
}

std::uint8_t shift_of(std::uint32_t stride) {
  return static_cast<std::uint8_t>(std::countr_zero(stride));
}

// The number of the element in a register: index - lower, within the bounds or a trap. What an instruction
// before has checked for the same register is not checked again.
void check_index(FunctionWork& work, Value& index, const Bounds& bounds) {
  Operands& operands = work.operands();
  const std::int32_t lower = bounds.lower;
  const auto last = static_cast<std::uint32_t>(bounds.upper) - static_cast<std::uint32_t>(lower);
  operands.settle_flags();
  RegisterId reg = operands.in_register(index);
  const bool known = operands.registers().within(reg, bounds);
  if (!known) operands.registers().bound(reg, bounds);
  if (lower != 0) {
    const RegisterId number = operands.allocate(false);
    work.out().lea(gp32(number),
                   x86::ptr(gp64(reg), static_cast<std::int32_t>(0u - static_cast<std::uint32_t>(lower))));
    operands.release(index);
    index = Value::of_register(StackType::I32, number);
    reg = number;
  }
  if (known) return;
  work.out().cmp(gp32(reg), last);
  work.out().ja(work.trap(TrapCode::IndexRange));
}

// number * stride as a 64-bit number in a register of its own.
void scale(FunctionWork& work, Value& number, std::uint32_t stride) {
  number.type = StackType::I64;  // the high half is zero
  const RegisterId reg = work.operands().in_own_register(number);
  if (stride != 1) work.out().imul(gp64(reg), gp64(reg), stride);
}

// Adds the checked number of an element to an address that has no index yet.
Value with_index(FunctionWork& work, const Value& base, Value number, std::uint32_t stride) {
  Location location = base.location;
  if (scalable(stride)) {
    location.index = work.operands().in_register(number);
    location.shift = shift_of(stride);
  } else {
    scale(work, number, stride);
    location.index = number.reg;
    location.shift = 0;
  }
  return Value::of_address(location);
}

// Adds it to an address that has an index: one register for both.
Value with_second_index(FunctionWork& work, const Value& base, Value number, std::uint32_t stride) {
  Operands& operands = work.operands();
  Location location = base.location;
  Value first = Value::of_register(StackType::I64, location.index);
  const RegisterId sum = operands.in_own_register(first);
  if (location.shift != 0) work.out().shl(gp64(sum), location.shift);
  if (scalable(stride)) {
    const RegisterId reg = operands.in_register(number);
    work.out().lea(gp64(sum), x86::ptr(gp64(sum), gp64(reg), shift_of(stride)));
  } else {
    scale(work, number, stride);
    work.out().add(gp64(sum), gp64(number.reg));
  }
  operands.release(number);
  location.index = sum;
  location.shift = 0;
  return Value::of_address(location);
}

// The Ref of an element, where nothing is known about the array's place.
Value dynamic_index(FunctionWork& work, Value base, Value number, std::uint32_t stride) {
  Operands& operands = work.operands();
  const RegisterId reg = operands.in_own_register(base);
  if (scalable(stride)) {
    work.out().lea(gp64(reg), x86::ptr(gp64(reg), gp64(operands.in_register(number)), shift_of(stride)));
  } else {
    scale(work, number, stride);
    work.out().add(gp64(reg), gp64(number.reg));
  }
  operands.release(number);
  return base;
}

// An index that is known: the element's address, or a trap for certain.
bool constant_index(FunctionWork& work, const Value& index, Value& base, const Instruction& in) {
  const auto value = std::int64_t{static_cast<std::int32_t>(index.constant)};
  if (value < in.signed_a() || value > in.signed_b()) {
    work.out().jmp(work.trap(TrapCode::IndexRange));
    return true;
  }
  if (!base.is(Value::Kind::Address)) return false;
  const auto distance = static_cast<std::uint64_t>(value - in.signed_a()) * in.c;
  if (base.location.offset + distance > kFarthestOperand) return false;
  base.location.offset += distance;
  return true;
}

void index(FunctionWork& work, const Instruction& in) {
  Operands& operands = work.operands();
  Value number = operands.pop_settled();
  Value base = operands.pop_settled();
  if (number.is(Value::Kind::Constant) && constant_index(work, number, base, in)) {
    return operands.push(base);
  }
  check_index(work, number, {in.signed_a(), in.signed_b()});
  if (in.signed_a() == in.signed_b() || in.c == 0) {  // the only element
    operands.release(number);
    operands.push(base);
  } else if (!base.is(Value::Kind::Address)) {
    operands.push(dynamic_index(work, base, number, in.c));
  } else if (base.location.fixed()) {
    operands.push(with_index(work, base, number, in.c));
  } else {
    operands.push(with_second_index(work, base, number, in.c));
  }
}

// Base, index, lower and upper bound, all known only when the program runs.
void index_between(FunctionWork& work, std::uint32_t stride) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  Value upper = operands.pop_settled();
  Value lower = operands.pop_settled();
  Value number = operands.pop_settled();
  Value base = operands.pop_settled();
  operands.settle_flags();
  const asmjit::Label outside = work.trap(TrapCode::IndexRange);
  const RegisterId least = operands.in_register(lower);
  const RegisterId most = operands.in_register(upper);
  const RegisterId reg = operands.in_own_register(number);
  out.cmp(gp32(reg), gp32(most));
  out.jg(outside);
  out.sub(gp32(reg), gp32(least));
  out.jl(outside);
  operands.release(lower);
  operands.release(upper);
  if (stride != 1) {
    out.mov(gp32(kScratch), stride);
    out.imul(gp64(reg), gp64(kScratch));
  }
  const RegisterId sum = operands.in_own_register(base);
  out.add(gp64(sum), gp64(reg));
  operands.release(number);
  operands.push(base);
}

// The frames of the one task that runs the function, or those of the task that runs it now.
void address_of_frame(FunctionWork& work, std::uint32_t offset) {
  Operands& operands = work.operands();
  const FunctionPlaces& places = work.own().places;
  Location location = work.absolute(static_cast<std::uint32_t>(places.framed(offset).first));
  if (!places.frames.empty() && !places.frames.single()) {
    const std::uint64_t lowest_frames = places.frames.lowest - work.code().record.frame_offset;
    operands.settle_flags();
    location.index = operands.allocate(false);
    const x86::Mem frames = x86::ptr(kContext, static_cast<std::int32_t>(offsetof(Context, frames)), 8);
    work.out().mov(gp64(location.index), frames);
    work.out().sub(gp64(location.index), static_cast<std::int32_t>(lowest_frames));
  }
  operands.push(Value::of_address(location));
}

void check_reference(FunctionWork& work, RegisterId reference, std::uint32_t bytes) {
  if (bytes > work.memory_size()) {
    work.out().jmp(work.reference_trap(reference));
    return;
  }
  work.out().cmp(gp64(reference), work.memory_size() - bytes);
  work.out().ja(work.reference_trap(reference));
}

}  // namespace

Location place_at(FunctionWork& work, Value& address, const MemoryEffect& effect, std::uint32_t bytes) {
  Operands& operands = work.operands();
  if (effect.fixed) {
    // Wherever the address is kept by now: this is the place.
    check_address(work, address, effect, bytes);
    operands.release(address);
    address = {};
    return {effect.extent.space, effect.extent.first, kNoRegister, 0};
  }
  if (effect.inside && address.is(Value::Kind::Address)) return address.location;
  if (!effect.inside) operands.settle_flags();
  const RegisterId reg = operands.in_register(address);
  if (!effect.inside) check_reference(work, reg, bytes);
  return {Space::Image, 0, reg, 0};
}

void push_load(FunctionWork& work, const Location& from, const MemoryEffect& effect, StackType slot) {
  const Pinned* const variable = work.pinned(effect);
  if (variable != nullptr) return work.operands().push(Value::of_register(slot, variable->reg));
  check_access(work, from, effect, size_of(effect.type));
  Value value = Value::of_load(effect.type, from, effect.extent);
  value.type = slot;
  value.plain = effect.type != MemType::Bool || work.facts().plain_bool(work.function(), effect.extent);
  work.operands().push(value);
}

bool translate_memory(FunctionWork& work, const Instruction& in) {
  Operands& operands = work.operands();
  if (is_memory_access(in.opcode)) {
    const MemoryAccess access = memory_access(in.opcode);
    access.store ? store_access(work, access, in) : load(work, access, in);
    return true;
  }
  switch (in.opcode) {
    case Opcode::LoadBit:
      load_bit(work, in);
      return true;
    case Opcode::StoreBit:
      store_bit(work, in);
      return true;
    case Opcode::LocalGet: {
      const StackType type = work.view().local_type(work.code().record, in.a);
      push_load(work, work.local(in.a), work.effect(false), type);
      return true;
    }
    case Opcode::LocalSet: {
      Value value = operands.pop_settled_beside_flags();
      store(work, work.local(in.a), work.effect(true), value);
      return true;
    }
    case Opcode::AddrAbs:
      operands.push(Value::of_address(work.absolute(in.a)));
      return true;
    case Opcode::AddrThis:
      operands.push(Value::of_address(work.of_self(in.a)));
      return true;
    case Opcode::AddrFrame:
      address_of_frame(work, in.a);
      return true;
    case Opcode::Index:
      index(work, in);
      return true;
    case Opcode::IndexDyn:
      index_between(work, in.a);
      return true;
    case Opcode::Offset:
      offset(work, in.a);
      return true;
    default:
      return false;
  }
}

}  // namespace stepwright::native

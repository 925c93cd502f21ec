#include "runtime/native/internal/x86/operands.h"

#include <cassert>
#include <limits>

namespace stepwright::native {

using bytecode::MemType;
using bytecode::StackType;
namespace x86 = asmjit::x86;

namespace {

// The index alone, without a base register.
x86::Mem scaled_index(const Location& location, std::int32_t offset) {
  return x86::ptr(static_cast<std::uint64_t>(static_cast<std::int64_t>(offset)), gp64(location.index),
                  location.shift);
}

}  // namespace

Value Operands::pop() {
  const Value value = stack_.back();
  stack_.pop_back();
  if (value.is(Value::Kind::Flags)) flags_pending_ = false;
  return value;
}

Value Operands::pop_settled() {
  settle_flags();
  return pop();
}

Value Operands::pop_settled_beside_flags() {
  return stack_.back().is(Value::Kind::Flags) ? pop_settled() : pop();
}

void Operands::release(const Value& value) {
  const RegisterId held = value.held();
  if (held != kNoRegister && !registers_.pinned(held)) registers_.release(held);
}

RegisterId Operands::allocate(bool floating) {
  RegisterId id = registers_.take(floating);
  while (id == kNoRegister) {
    spill_one(floating);
    id = registers_.take(floating);
  }
  return id;
}

// Sends the deepest operand that holds such a register to its slot.
void Operands::spill_one(bool floating) {
  for (std::uint32_t i = 0; i < depth(); ++i) {
    if (stack_[i].is(Value::Kind::Flags)) spill(i);
  }
  for (std::uint32_t i = 0; i < depth(); ++i) {
    const RegisterId held = stack_[i].held();
    if (held == kNoRegister || is_xmm(held) != floating || registers_.pinned(held)) continue;
    return spill(i);
  }
  assert(false && "more operands at once than registers");
}

// The value in a register without taking one: its own, or the scratch register.
RegisterId Operands::read_scratch(Value& value) {
  if (value.is(Value::Kind::Register)) return value.reg;
  if (value.is(Value::Kind::Address)) {
    address_into(kScratch, value.location);
  } else if (value.is(Value::Kind::Flags)) {
    out_.set(value.condition, gp8(kScratch));
    flags_pending_ = false;
  } else if (value.is(Value::Kind::Constant)) {
    load_constant(value, kScratch);
  } else {
    Value bits = value;
    if (value.memory == MemType::F32) bits.memory = MemType::I32;
    if (value.memory == MemType::F64) bits.memory = MemType::I64;
    read_into(kScratch, bits);
  }
  return kScratch;
}

void Operands::spill(std::uint32_t index) {
  Value& value = stack_[index];
  const Location target = slot(index);
  const StackType type = value.type;
  const std::uint32_t bytes = width_of(type);
  const RegisterId from = read_scratch(value);
  forget_slot(index);
  store_register(target, bytes, from);
  release(value);
  value = Value::of_load(slot_memory(type), target);
  value.type = type;
}

// Before a slot changes: a register may still hold the operand that lay there.
void Operands::forget_slot(std::uint32_t index) {
  const std::uint64_t at = slot(index).offset;
  registers_.forget_overlapping({Space::Slot, at, at + kSlotBytes}, instances_);
}

void Operands::store_register(const Location& to, std::uint32_t bytes, RegisterId from) {
  const x86::Mem target = memory(to, bytes);
  if (is_xmm(from)) {
    bytes == 4 ? out_.movss(target, xmm(from)) : out_.movsd(target, xmm(from));
  } else {
    out_.mov(target, general(from, bytes));
  }
}

void Operands::claim(RegisterId id) {
  for (std::uint32_t i = 0; i < depth() && registers_.uses(id) > 0; ++i) {
    if (stack_[i].held() != id) continue;
    Value& value = stack_[i];
    const RegisterId free = registers_.take(false);
    if (free == kNoRegister) {
      spill(i);
      continue;
    }
    out_.mov(gp64(free), gp64(id));
    registers_.release(id);
    (value.is(Value::Kind::Register) ? value.reg : value.location.index) = free;
  }
  registers_.take_exactly(id);
}

void Operands::settle(Value& value) {
  flags_pending_ = false;
  RegisterId reg = registers_.take(false);
  if (reg != kNoRegister) {
    out_.set(value.condition, gp8(reg));
  } else {
    // Not in the scratch register: what is spilled may need that.
    const x86::Mem kept = x86::ptr(kContext, static_cast<std::int32_t>(offsetof(Context, condition)), 1);
    out_.set(value.condition, kept);
    value = Value::of_constant(StackType::Bool, 0);  // nothing of it is left to spill
    reg = allocate(false);
    out_.movzx(gp32(reg), kept);
  }
  value = Value::of_register(StackType::Bool, reg);
}

void Operands::settle_flags() {
  if (!flags_pending_) return;
  for (Value& value : stack_) {
    if (value.is(Value::Kind::Flags)) settle(value);
  }
}

void Operands::push_flags(x86::CondCode condition) {
  assert(!flags_pending_);
  Value value;
  value.kind = Value::Kind::Flags;
  value.type = StackType::Bool;
  value.condition = condition;
  flags_pending_ = true;
  push(value);
}

RegisterId Operands::in_register(Value& value) {
  switch (value.kind) {
    case Value::Kind::Register:
      break;
    case Value::Kind::Constant: {
      const RegisterId reg = allocate(is_float(value.type));
      load_constant(value, reg);
      value = Value::of_register(value.type, reg);
      break;
    }
    case Value::Kind::Load:
      read(value);
      break;
    case Value::Kind::Address:
      compute_address(value);
      break;
    case Value::Kind::Flags:
      settle(value);
      break;
  }
  return value.reg;
}

RegisterId Operands::in_own_register(Value& value) {
  const RegisterId reg = in_register(value);
  if (!registers_.pinned(reg) && registers_.uses(reg) == 1) {
    registers_.forget(reg);
    return reg;
  }
  const RegisterId copy = allocate(is_float(value.type));
  move(value.type, copy, reg);
  release(value);
  value = Value::of_register(value.type, copy);
  return copy;
}

void Operands::into(RegisterId target, Value& value) {
  if (value.is(Value::Kind::Constant)) {
    load_constant(value, target);
  } else {
    const RegisterId reg = in_register(value);
    move(value.type, target, reg);
    release(value);
  }
  value = Value::of_register(value.type, target);
}

void Operands::into_claimed(RegisterId target, Value& value) {
  if (value.is(Value::Kind::Register) && value.reg == target && registers_.uses(target) == 1) return;
  push(value);
  claim(target);
  value = pop();
  into(target, value);
}

void Operands::load_constant(const Value& value, RegisterId reg) {
  if (is_xmm(reg)) {
    if (value.constant == 0) {
      out_.xorps(xmm(reg), xmm(reg));
    } else if (value.type == StackType::F32) {
      out_.movss(xmm(reg), constant(value.constant, 4));
    } else {
      out_.movsd(xmm(reg), constant(value.constant, 8));
    }
  } else if (value.constant <= std::numeric_limits<std::uint32_t>::max()) {
    out_.mov(gp32(reg), static_cast<std::uint32_t>(value.constant));
  } else {
    out_.mov(gp64(reg), value.constant);
  }
}

void Operands::move(StackType type, RegisterId to, RegisterId from) {
  if (to == from) return;
  if (is_xmm(to)) {
    out_.movaps(xmm(to), xmm(from));
  } else if (width_of(type) == 8) {
    out_.mov(gp64(to), gp64(from));
  } else {
    out_.mov(gp32(to), gp32(from));
  }
}

asmjit::Operand Operands::source(Value& value, std::uint32_t bytes) {
  if (value.is(Value::Kind::Constant)) {
    const auto wide = static_cast<std::int64_t>(value.constant);
    if (bytes <= 4) return asmjit::Imm(static_cast<std::int32_t>(value.constant));
    if (wide == static_cast<std::int32_t>(wide)) return asmjit::Imm(wide);
  }
  if (value.is(Value::Kind::Load) && value.bytes() == bytes && value.memory != MemType::Ref) {
    const bool whole =
        value.type != StackType::Bool || (value.plain && !value.inverted && value.bit == bytecode::kNoBit);
    const bool known = registers_.find(value.where, value.memory) != kNoRegister;
    if (whole && !known) return memory(value.location, bytes);
  }
  return general(in_register(value), bytes);
}

asmjit::Operand Operands::float_source(Value& value) {
  const std::uint32_t bytes = width_of(value.type);
  if (value.is(Value::Kind::Constant) && value.constant != 0) return constant(value.constant, bytes);
  if (value.is(Value::Kind::Load)) {
    const bool known = registers_.find(value.where, value.memory) != kNoRegister;
    if (!known) return memory(value.location, bytes);
  }
  return xmm(in_register(value));
}

void Operands::compute_address(Value& value) {
  const Location location = value.location;
  RegisterId reg = location.index;
  const bool reuse = reg != kNoRegister && !registers_.pinned(reg) && registers_.uses(reg) == 1;
  if (!reuse) reg = allocate(false);
  registers_.forget(reg);
  address_into(reg, location);
  if (!reuse) release(value);
  value = Value::of_register(StackType::Ref, reg);
}

// Leaves the flags as they are.
void Operands::address_into(RegisterId target, const Location& location) {
  const auto offset = static_cast<std::int32_t>(location.offset);
  if (location.space == Space::Image && location.fixed()) {
    out_.mov(gp32(target), static_cast<std::uint32_t>(location.offset));
    return;
  }
  if (location.space == Space::Image) {
    out_.lea(gp64(target), scaled_index(location, offset));
    return;
  }
  // self - image = self + not(image) + 1
  out_.mov(gp64(kScratch), kImage);
  out_.not_(gp64(kScratch));
  out_.lea(gp64(kScratch), x86::ptr(gp64(kScratch), kSelf, 0, offset + 1));
  if (location.fixed()) {
    out_.mov(gp64(target), gp64(kScratch));
  } else {
    out_.lea(gp64(target), x86::ptr(gp64(kScratch), gp64(location.index), location.shift));
  }
}

x86::Mem Operands::memory(const Location& location, std::uint32_t bytes) const {
  const x86::Gp base = location.space == Space::Image      ? kImage
                       : location.space == Space::Instance ? kSelf
                                                           : kContext;
  const auto offset = static_cast<std::int32_t>(location.offset);
  if (location.fixed()) return x86::ptr(base, offset, bytes);
  return x86::ptr(base, gp64(location.index), location.shift, offset, bytes);
}

Location Operands::slot(std::uint32_t index) const {
  return {Space::Slot, first_slot_ + std::uint64_t{index} * kSlotBytes, kNoRegister, 0};
}

void Operands::before_write(const Extent& extent) {
  for (Value& value : stack_) {
    if (value.is(Value::Kind::Load) && may_overlap(value.where, extent, instances_)) read(value);
  }
  registers_.forget_overlapping(extent, instances_);
}

void Operands::before_pinned_write(RegisterId id) {
  registers_.forget(id);
  for (Value& value : stack_) {
    if (value.held() != id) continue;
    if (value.is(Value::Kind::Register)) {
      const RegisterId copy = allocate(is_xmm(id));
      move(value.type, copy, id);
      value.reg = copy;
    } else {
      copy_index(value);
    }
  }
}

void Operands::copy_index(Value& value) {
  const RegisterId copy = allocate(false);
  out_.mov(gp64(copy), gp64(value.location.index));
  value.location.index = copy;
}

void Operands::store_all() {
  settle_flags();
  for (std::uint32_t i = 0; i < depth(); ++i) {
    Value& value = stack_[i];
    const Location own = slot(i);
    const bool there = value.is(Value::Kind::Load) && value.location.space == Space::Slot &&
                       value.location.offset == own.offset && !value.inverted;
    if (there) continue;
    in_register(value);
    spill(i);
  }
}

void Operands::save_for_call() {
  settle_flags();
  for (std::uint32_t i = 0; i < depth(); ++i) {
    Value& value = stack_[i];
    if (value.is(Value::Kind::Constant)) continue;
    if (value.is(Value::Kind::Address) && value.location.fixed()) continue;
    if (value.is(Value::Kind::Load) && value.location.space == Space::Slot) continue;
    in_register(value);
    spill(i);
  }
  registers_.forget_all();
}

void Operands::begin_block(const std::vector<StackType>& types) {
  for (const Value& value : stack_) release(value);
  stack_.clear();
  registers_.forget_all();
  for (const StackType type : types) push_slot(type);
  flags_pending_ = false;
}

void Operands::pop_to_slot() {
  Value value = pop_settled();
  const RegisterId from = in_register(value);
  forget_slot(depth());
  x86::Mem target = slot_memory_at(depth());
  if (value.type == StackType::Bool) {
    out_.movzx(gp32(kScratch), gp8(from));
    out_.mov(target, gp64(kScratch));
  } else if (value.type == StackType::F32) {
    out_.movd(gp32(kScratch), xmm(from));
    out_.mov(target, gp64(kScratch));
  } else if (is_xmm(from)) {
    out_.movsd(target, xmm(from));
  } else {
    out_.mov(target, gp64(from));
  }
  release(value);
}

void Operands::push_slot(StackType type) {
  Value value = Value::of_load(slot_memory(type), slot(depth()));
  value.type = type;
  push(value);
}

std::vector<StackType> Operands::types() const {
  std::vector<StackType> types;
  for (const Value& value : stack_) types.push_back(value.type);
  return types;
}

}  // namespace stepwright::native

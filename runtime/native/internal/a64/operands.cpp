#include "runtime/native/internal/a64/operands.h"

#include <cassert>

namespace stepwright::native::a64 {

using bytecode::StackType;

void Operands::push_constant(StackType type, std::uint64_t bits) {
  stack_.push_back({Operand::Kind::Constant, type, kNoRegister, depth(), bits});
}

void Operands::push_register(StackType type, RegisterId reg) {
  used_[reg] = true;
  stack_.push_back({Operand::Kind::Register, type, reg, depth(), 0});
}

void Operands::push_slot(StackType type) {
  stack_.push_back({Operand::Kind::Slot, type, kNoRegister, depth(), 0});
}

Operand Operands::pop() {
  const Operand top = stack_.back();
  stack_.pop_back();
  return top;
}

RegisterId Operands::pop_register() {
  Operand top = pop();
  return in_register(top);
}

RegisterId Operands::in_register(Operand& popped) {
  if (popped.is(Operand::Kind::Register)) return popped.reg;
  const RegisterId reg = allocate(is_float(popped.type));
  if (popped.is(Operand::Kind::Constant)) {
    load_constant(reg, popped);
  } else {
    emit_.load_slot(reg, slot_memory(popped.slot));
  }
  popped.kind = Operand::Kind::Register;
  popped.reg = reg;
  return reg;
}

void Operands::load_constant(RegisterId to, const Operand& from) {
  if (!is_float(from.type)) return emit_.constant(x(to), from.constant);
  const bool single = from.type == StackType::F32;
  if (from.constant == 0) {
    single ? emit_.out().fmov(s(to), w(GpW::kIdZr)) : emit_.out().fmov(d(to), x(GpX::kIdZr));
    return;
  }
  emit_.constant(x(kScratch), from.constant);
  single ? emit_.out().fmov(s(to), w(kScratch)) : emit_.out().fmov(d(to), x(kScratch));
}

RegisterId Operands::allocate(bool vector) {
  const RegisterId first = vector ? kFirstVector : 0;
  const RegisterId end = vector ? kRegisterCount : kFirstVector;
  for (RegisterId reg = first; reg < end; ++reg) {
    if (used_[reg] || !holds_values(reg)) continue;
    used_[reg] = true;
    return reg;
  }
  for (std::uint32_t i = 0; i < depth(); ++i) {
    if (!stack_[i].is(Operand::Kind::Register) || is_vector(stack_[i].reg) != vector) continue;
    const RegisterId reg = stack_[i].reg;
    spill(i);
    used_[reg] = true;
    return reg;
  }
  assert(false && "an instruction needs more registers than there are");
  return first;
}

void Operands::spill(std::uint32_t index) {
  Operand& operand = stack_[index];
  emit_.store_slot(slot_memory(index), operand.reg);
  used_[operand.reg] = false;
  operand.kind = Operand::Kind::Slot;
  operand.reg = kNoRegister;
}

void Operands::store_all() {
  for (std::uint32_t i = 0; i < depth(); ++i) {
    Operand& operand = stack_[i];
    if (operand.is(Operand::Kind::Register)) spill(i);
    if (!operand.is(Operand::Kind::Constant)) continue;
    emit_.constant(x(kScratch), operand.constant);
    emit_.out().str(x(kScratch), slot_memory(i));
    operand.kind = Operand::Kind::Slot;
  }
}

void Operands::save_for_call() {
  for (std::uint32_t i = 0; i < depth(); ++i) {
    if (stack_[i].is(Operand::Kind::Register)) spill(i);
  }
}

std::vector<StackType> Operands::types() const {
  std::vector<StackType> types;
  for (const Operand& operand : stack_) types.push_back(operand.type);
  return types;
}

void Operands::begin_block(const std::vector<StackType>& types) {
  stack_.clear();
  used_ = {};
  for (const StackType type : types) push_slot(type);
}

}  // namespace stepwright::native::a64

#include "runtime/native/internal/x86/function_work.h"

#include "runtime/native/internal/x86/effect_check.h"

namespace stepwright::native {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;

FunctionWork::FunctionWork(ProgramWork& program, std::uint32_t function)
    : program_(program),
      function_(function),
      operands_(program.out, program.pool, own().places.instances,
                own().places.first_slot + code().record.local_count * kSlotBytes) {
  if (program.checks == nullptr) return;
  operands_.set_check([this](const Value& load, RegisterId known) { check_known(*this, load, known); });
}

const bytecode::Instruction* FunctionWork::next() const {
  const std::uint32_t index = item_ + 1;
  if (index >= code().items.size() || code().items[index].is_target) return nullptr;
  if (loop_ != nullptr && index > loop_->last) return nullptr;
  return &code().items[index].instruction;
}

void FunctionWork::enter_loop(const Loop& loop) {
  loop_ = &loop;
  for (const Pinned& variable : loop.variables) {
    const Location from{variable.where.space, variable.where.first, kNoRegister, 0};
    Value value = Value::of_load(variable.type, from);
    operands_.registers().pin(variable.reg);
    operands_.read_pinned(value, variable.reg);
  }
}

void FunctionWork::leave_loop() {
  for (const Pinned& variable : loop_->variables) {
    operands_.before_pinned_write(variable.reg);
    operands_.registers().unpin(variable.reg);
  }
  loop_ = nullptr;
}

const Pinned* FunctionWork::pinned(const MemoryEffect& effect) const {
  if (loop_ == nullptr || !effect.is_scalar()) return nullptr;
  for (const Pinned& variable : loop_->variables) {
    if (variable.type == effect.type && variable.where == effect.extent) return &variable;
  }
  return nullptr;
}

void FunctionWork::write_back() {
  if (loop_ != nullptr) write_back(*loop_);
}

void FunctionWork::write_back(const Loop& loop) {
  for (const Pinned& variable : loop.variables) {
    if (!variable.written) continue;
    const Location to{variable.where.space, variable.where.first, kNoRegister, 0};
    operands_.store_register(to, size_of(variable.type), variable.reg);
  }
}

asmjit::Label FunctionWork::trap(bytecode::TrapCode code, std::uint32_t refund) {
  program_.sites.push_back({code, function_, current().pc});
  Cold cold;
  cold.label = out().newLabel();
  cold.loop = loop_;
  cold.site = static_cast<std::uint32_t>(program_.sites.size());
  cold.refund = refund;
  cold_.push_back(cold);
  return cold.label;
}

void FunctionWork::charge(std::uint32_t cost, asmjit::Label paid) {
  out().sub(kBudget, cost);
  out().jae(paid);
  const asmjit::Label refused = trap(TrapCode::Watchdog, cost);
  cold_.back().paid = paid;
  out().jmp(refused);
}

void FunctionWork::charge(std::uint32_t cost) {
  const asmjit::Label paid = out().newLabel();
  out().sub(kBudget, cost);
  out().jb(trap(TrapCode::Watchdog, cost));
  cold_.back().paid = paid;
  out().bind(paid);
}

// The slice of the budget is too small: another one, if there is any.
void FunctionWork::emit_refill(const Cold& cold) {
  out().add(kBudget, cold.refund);
  out().mov(asmjit::x86::ptr(kContext, static_cast<std::int32_t>(offsetof(Context, cost)), 4), cold.refund);
  out().call(program_.refill);
  out().sub(kBudget, cold.refund);
  out().jae(cold.paid);
}

asmjit::Label FunctionWork::reference_trap(RegisterId reference) {
  const asmjit::Label label = trap(bytecode::TrapCode::BadReference);
  program_.sites.push_back({bytecode::TrapCode::NullReference, function_, current().pc});
  cold_.back().reference = reference;
  return label;
}

asmjit::Label FunctionWork::leaving(asmjit::Label target) {
  Cold cold;
  cold.label = out().newLabel();
  cold.loop = loop_;
  cold.target = target;
  cold_.push_back(cold);
  return cold.label;
}

void FunctionWork::emit_cold() {
  for (const Cold& cold : cold_) {
    out().bind(cold.label);
    if (cold.paid.isValid()) emit_refill(cold);
    if (cold.loop != nullptr) write_back(*cold.loop);
    if (cold.target.isValid()) {
      out().jmp(cold.target);
      continue;
    }
    if (cold.refund != 0) out().add(kBudget, cold.refund);
    if (cold.reference != kNoRegister) {
      out().mov(gp32(kScratch), bytecode::kNullRef);
      out().cmp(gp64(cold.reference), gp64(kScratch));
    }
    out().mov(asmjit::x86::eax, cold.site);
    if (cold.reference != kNoRegister) {
      out().jb(program_.trapped);
      out().mov(asmjit::x86::eax, cold.site + 1);
    }
    out().jmp(program_.trapped);
  }
  cold_.clear();
}

Location FunctionWork::of_self(std::uint32_t offset) const {
  const Extent own_bytes = own().places.own(offset, 0);
  return {own_bytes.space, own_bytes.first, kNoRegister, 0};
}

Location FunctionWork::local(std::uint32_t index) const {
  return {Space::Slot, own().places.first_slot + std::uint64_t{index} * kSlotBytes, kNoRegister, 0};
}

asmjit::x86::Mem FunctionWork::saved_self() const {
  return operands_.memory(local(code().record.local_count + code().record.max_stack), 8);
}

RegisterId FunctionWork::destination(StackType type) {
  const bytecode::Instruction* const store = next();
  if (loop_ == nullptr || store == nullptr) return kNoRegister;
  if (store->opcode != Opcode::LocalSet) {
    if (!is_memory_access(store->opcode)) return kNoRegister;
    const MemoryAccess access = memory_access(store->opcode);
    // A narrow integer is cut to its type by the store itself.
    const bool whole = size_of(access.type) == size_of(slot_memory(type));
    if (!access.store || access.mode == AddressMode::Ind || !whole) return kNoRegister;
  }
  const Pinned* const variable = pinned(effect_of(item_ + 1, true));
  if (variable == nullptr) return kNoRegister;
  operands_.before_pinned_write(variable->reg);
  ahead_ = variable->reg;
  return variable->reg;
}

}  // namespace stepwright::native

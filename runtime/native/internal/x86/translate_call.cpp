#include <algorithm>
#include <cstring>

#include "runtime/native/internal/x86/effect_check.h"
#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using bytecode::FunctionRecord;
using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::Section;
using bytecode::StackType;
using bytecode::TrapCode;
namespace x86 = asmjit::x86;

namespace {

// Arguments go straight to the callee's locals.
void pass_arguments(FunctionWork& work, std::uint32_t callee, const FunctionRecord& record) {
  Operands& operands = work.operands();
  const std::uint32_t first_slot = work.facts().facts(callee).places.first_slot;
  for (std::uint32_t i = record.param_count; i > 0; --i) {
    const StackType type = work.view().local_type(record, i - 1);
    Value value = operands.pop_settled();
    const Location to{Space::Slot, first_slot + std::uint64_t{i - 1} * kSlotBytes, kNoRegister, 0};
    operands.store_register(to, width_of(type), operands.in_register(value));
    operands.release(value);
  }
}

void emit_call(FunctionWork& work, std::uint32_t callee) {
  const FunctionCode::Item& item = work.current();
  work.out().call(work.program().functions[callee]);
  work.program().calls.push_back({work.out().offset(), work.function(), item.pc + item.instruction.size});
}

// The caller's instance survives the call.
class SelfGuard {
 public:
  SelfGuard(FunctionWork& work, std::uint32_t callee)
      : out_(work.out()),
        needed_(work.own().uses_self &&
                (work.facts().facts(callee).uses_self || work.facts().facts(callee).spoils_self)),
        slot_(work.saved_self()) {
    if (needed_) out_.mov(slot_, kSelf);
  }
  void restore() {
    if (needed_) out_.mov(kSelf, slot_);
  }

 private:
  x86::Assembler& out_;
  bool needed_;
  x86::Mem slot_;
};

void call_function(FunctionWork& work, std::uint32_t callee) {
  Operands& operands = work.operands();
  const FunctionRecord record = work.view().record<Section::Functions>(callee);
  pass_arguments(work, callee, record);
  operands.save_for_call();
  work.charge(record.code_size);
  SelfGuard guard(work, callee);
  emit_call(work, callee);
  guard.restore();
  if (record.result == bytecode::kNoResult) return;
  const auto type = static_cast<StackType>(record.result);
  const RegisterId result = is_float(type) ? kXmm0 : kRax;
  operands.registers().take_exactly(result);
  operands.push(Value::of_register(type, result));
}

// Puts the callee's instance into the register, where the callee needs it.
void set_self(FunctionWork& work, const Instruction& in, RegisterId ref) {
  x86::Assembler& out = work.out();
  if (in.opcode == Opcode::CallInstanceInd) {
    out.lea(kSelf, x86::ptr(kImage, gp64(ref)));
    return;
  }
  const Location to = in.opcode == Opcode::CallInstanceAbs ? work.absolute(in.b) : work.of_self(in.b);
  out.lea(kSelf, work.operands().memory(to, 8));
}

void call_instance(FunctionWork& work, const Instruction& in) {
  Operands& operands = work.operands();
  const FunctionRecord record = work.view().record<Section::Functions>(in.a);
  RegisterId ref = kNoRegister;
  if (in.opcode == Opcode::CallInstanceInd) {
    // The Ref is checked even where it leads to the only instance that there is.
    Value value = operands.pop_settled();
    operands.settle_flags();
    operands.into_claimed(kRax, value);
    ref = kRax;
    work.out().cmp(gp64(ref),
                   work.memory_size() - std::min<std::uint64_t>(record.instance_size, work.memory_size()));
    work.out().ja(work.reference_trap(ref));
  }
  operands.save_for_call();
  work.charge(record.code_size);
  SelfGuard guard(work, in.a);
  if (work.facts().facts(in.a).uses_self) set_self(work, in, ref);
  if (ref != kNoRegister) operands.registers().release(ref);
  emit_call(work, in.a);
  guard.restore();
}

using CopyFunction = void* (*)(void*, const void*, std::size_t);

void call_library_copy(FunctionWork& work, x86::Mem to, x86::Mem from, std::uint32_t bytes) {
  x86::Assembler& out = work.out();
  out.lea(gp64(kScratch), to);
  out.lea(x86::rsi, from);
  out.mov(x86::rdi, gp64(kScratch));
  out.mov(x86::edx, bytes);
  call_aligned(out, reinterpret_cast<std::uint64_t>(static_cast<CopyFunction>(&std::memmove)));
}

// Everything is read before anything is written, as the two may overlap.
void copy_in_place(FunctionWork& work, const Location& to, const Location& from, std::uint32_t bytes) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  const std::uint32_t unit = bytes >= 16 ? 16 : bytes >= 8 ? 8 : bytes >= 4 ? 4 : bytes >= 2 ? 2 : 1;
  std::vector<std::uint32_t> offsets;
  for (std::uint32_t at = 0; at + unit < bytes; at += unit) offsets.push_back(at);
  offsets.push_back(bytes - unit);
  std::vector<RegisterId> parts;
  const auto at = [&](const Location& base, std::uint32_t distance) {
    Location place = base;
    place.offset += distance;
    return operands.memory(place, unit);
  };
  for (const std::uint32_t distance : offsets) {
    const RegisterId part = operands.allocate(unit >= 4);
    parts.push_back(part);
    const x86::Mem source = at(from, distance);
    if (unit == 16) out.movups(xmm(part), source);
    if (unit == 8) out.movq(xmm(part), source);
    if (unit == 4) out.movd(xmm(part), source);
    if (unit < 4) out.movzx(gp32(part), source);
  }
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const x86::Mem target = at(to, offsets[i]);
    if (unit == 16) out.movups(target, xmm(parts[i]));
    if (unit == 8) out.movq(target, xmm(parts[i]));
    if (unit == 4) out.movd(target, xmm(parts[i]));
    if (unit < 4) out.mov(target, general(parts[i], unit));
    operands.registers().release(parts[i]);
  }
}

void copy(FunctionWork& work, std::uint32_t bytes) {
  Operands& operands = work.operands();
  Value source = operands.pop_settled();
  Value target = operands.pop_settled();
  const Location from = place_at(work, source, work.effect(false), bytes);
  const Location to = place_at(work, target, work.effect(true), bytes);
  check_access(work, from, work.effect(false), bytes);
  check_access(work, to, work.effect(true), bytes);
  const std::uint32_t cost = bytes / 16;
  operands.before_write(work.effect(true).extent);
  if (cost != 0) {
    operands.settle_flags();
    work.charge(cost);
  }
  if (bytes > 0 && bytes <= kLargestInlineCopy) {
    copy_in_place(work, to, from, bytes);
  } else if (bytes > 0) {
    operands.save_for_call();
    call_library_copy(work, operands.memory(to, bytes), operands.memory(from, bytes), bytes);
  }
  operands.release(source);
  operands.release(target);
}

void leave(FunctionWork& work) {
  Operands& operands = work.operands();
  if (work.code().record.result != bytecode::kNoResult) {
    Value value = operands.pop_settled();
    const RegisterId target = is_float(value.type) ? kXmm0 : kRax;
    if (value.is(Value::Kind::Register) && value.reg == target) {
      operands.release(value);
    } else {
      // Nothing else is left that the register could hold.
      const RegisterId from = operands.in_register(value);
      if (is_float(value.type)) {
        work.out().movaps(xmm(target), xmm(from));
      } else {
        work.out().mov(gp64(target), gp64(from));
      }
      operands.release(value);
    }
  }
  work.write_back();
  work.out().ret();
}

}  // namespace

bool translate_call(FunctionWork& work, const Instruction& in) {
  switch (in.opcode) {
    case Opcode::Call:
      return call_function(work, in.a), true;
    case Opcode::CallInstanceAbs:
    case Opcode::CallInstanceThis:
    case Opcode::CallInstanceInd:
      return call_instance(work, in), true;
    case Opcode::MemCopy:
      return copy(work, in.a), true;
    case Opcode::Return:
      return leave(work), true;
    case Opcode::Trap:
      return work.out().jmp(work.trap(static_cast<TrapCode>(in.a))), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native

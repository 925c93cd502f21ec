#include <cstring>

#include "runtime/native/internal/a64/translate.h"
#include "runtime/native/internal/library_call.h"

namespace stepwright::native::a64 {

using bytecode::FunctionRecord;
using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::OperationInfo;
using bytecode::Section;
using bytecode::StackType;
using bytecode::TrapCode;

namespace {

// Arguments go straight to the callee's locals.
void pass_arguments(FunctionWork& work, std::uint32_t callee, const FunctionRecord& record) {
  const std::uint64_t first_slot = work.facts().facts(callee).places.first_slot;
  for (std::uint32_t i = record.param_count; i > 0; --i) {
    const RegisterId value = work.operands().pop_register();
    work.emit().store_slot(work.emit().memory(kContext, first_slot + (i - 1) * kSlotBytes, kSlotBytes),
                           value);
    work.operands().release(value);
  }
}

void emit_call(FunctionWork& work, std::uint32_t callee) {
  const FunctionCode::Item& item = work.code().items[work.item()];
  work.out().bl(work.program().functions[callee]);
  work.program().calls.push_back({work.out().offset(), work.function(), item.pc + item.instruction.size});
}

void call_function(FunctionWork& work, std::uint32_t callee) {
  Operands& operands = work.operands();
  const auto record = work.view().record<Section::Functions>(callee);
  pass_arguments(work, callee, record);
  operands.save_for_call();
  work.charge(record.code_size);
  emit_call(work, callee);
  if (record.result == bytecode::kNoResult) return;
  const auto type = static_cast<StackType>(record.result);
  operands.push_register(type, is_float(type) ? kFirstVector : RegisterId{0});
}

void call_instance(FunctionWork& work, const Instruction& in) {
  Operands& operands = work.operands();
  const auto record = work.view().record<Section::Functions>(in.a);
  RegisterId reference = kNoRegister;
  if (in.opcode == Opcode::CallInstanceInd) {
    reference = operands.pop_register();
    check_reference(work, reference, record.instance_size);
  }
  operands.save_for_call();
  work.charge(record.code_size);
  work.out().str(kSelf, work.saved_self());
  if (reference != kNoRegister) {
    work.out().add(kSelf, kImage, x(reference));
    operands.release(reference);
  } else {
    work.emit().add(kSelf, in.opcode == Opcode::CallInstanceAbs ? kImage : kSelf, in.b);
  }
  emit_call(work, in.a);
  work.out().ldr(kSelf, work.saved_self());
}

void call_platform(FunctionWork& work, std::uint64_t function) {
  work.emit().constant(x(kScratch), function);
  work.out().blr(x(kScratch));
}

using CopyFunction = void* (*)(void*, const void*, std::size_t);

void copy(FunctionWork& work, std::uint32_t bytes) {
  Operands& operands = work.operands();
  const RegisterId source = operands.pop_register();
  const RegisterId target = operands.pop_register();
  check_reference(work, source, bytes);
  check_reference(work, target, bytes);
  if (bytes >= 16) work.charge(bytes / 16);
  operands.release(source);
  operands.release(target);
  if (bytes == 0) return;
  operands.save_for_call();
  work.out().add(x(kAddress), kImage, x(source));
  work.out().add(GpX(0), kImage, x(target));
  work.out().mov(GpX(1), x(kAddress));
  work.emit().constant(GpX(2), bytes);
  call_platform(work, reinterpret_cast<std::uint64_t>(static_cast<CopyFunction>(&std::memmove)));
}

// The result goes to the register where the caller looks for it.
void leave(FunctionWork& work) {
  if (work.code().record.result != bytecode::kNoResult) {
    const StackType type = work.operands().top_type();
    const RegisterId value = work.operands().pop_register();
    if (is_float(type) && value != kFirstVector) work.out().fmov(d(kFirstVector), d(value));
    if (!is_float(type) && value != 0) work.out().mov(GpX(0), x(value));
    work.operands().release(value);
  }
  work.out().ldp(GpX(29), GpX(30), ptr_post(GpX(GpX::kIdSp), 16));
  work.out().ret(GpX(30));
}

// The operands go to their slots, as the interpreter's stack would hold them; the result comes back in one.
void call_library(FunctionWork& work, LibraryCall function, std::uint32_t operation,
                  const OperationInfo& info) {
  Operands& operands = work.operands();
  const auto count = static_cast<std::uint32_t>(std::strlen(info.pops));
  operands.store_all();
  const std::uint64_t behind = operands.slot_offset(operands.depth());
  for (std::uint32_t i = 0; i < count; ++i) operands.pop();
  work.out().str(kBudget, work.field(offsetof(Context, budget)));
  work.out().mov(GpX(0), kContext);
  work.emit().constant(GpW(1), operation);
  work.emit().add(GpX(2), kContext, behind);
  call_platform(work, reinterpret_cast<std::uint64_t>(function));
  work.out().ldr(kBudget, work.field(offsetof(Context, budget)));
  work.out().cmp(GpW(0), 0);
  work.emit().branch(CondCode::kNE, work.trap(TrapCode::None));  // the context knows which
  if (*info.pushes != '\0') operands.push_slot(type_named(*info.pushes));
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
      return work.out().b(work.trap(static_cast<TrapCode>(in.a))), true;
    default:
      return false;
  }
}

bool translate_library(FunctionWork& work, const Instruction& in) {
  switch (in.opcode) {
    case Opcode::StringOp:
      return call_library(work, &run_string_op, in.a, bytecode::kStringOps[in.a]), true;
    case Opcode::Intrinsic:
      return call_library(work, &run_intrinsic, in.a, bytecode::kIntrinsics[in.a]), true;
    default:
      return false;
  }
}

}  // namespace stepwright::native::a64

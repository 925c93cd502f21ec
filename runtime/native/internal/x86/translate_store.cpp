#include "runtime/native/internal/x86/effect_check.h"
#include "runtime/native/internal/x86/translate.h"

namespace stepwright::native {

using bytecode::MemType;
using bytecode::StackType;
namespace x86 = asmjit::x86;

namespace {

// True if the value is what a load of this narrow type would give: the instruction before saw to it.
bool wrapped(FunctionWork& work, MemType type) {
  using bytecode::Opcode;
  if (work.item() == 0 || work.current().is_target) return false;
  switch (work.code().items[work.item() - 1].instruction.opcode) {
    case Opcode::WrapI8:
      return type == MemType::I8;
    case Opcode::WrapU8:
      return type == MemType::U8;
    case Opcode::WrapI16:
      return type == MemType::I16;
    case Opcode::WrapU16:
      return type == MemType::U16;
    default:
      return false;
  }
}

void store_pinned(FunctionWork& work, const Pinned& variable, Value& value) {
  Operands& operands = work.operands();
  x86::Assembler& out = work.out();
  operands.before_pinned_write(variable.reg);
  const bool narrow = size_of(variable.type) < 4 && variable.type != MemType::Bool;
  if (!narrow || wrapped(work, variable.type)) {
    operands.into(variable.reg, value);
    return write_through(work, variable);
  }
  const std::uint32_t bytes = size_of(variable.type);
  const RegisterId from = operands.in_register(value);
  const bool is_signed = variable.type == MemType::I8 || variable.type == MemType::I16;
  is_signed ? out.movsx(gp32(variable.reg), general(from, bytes))
            : out.movzx(gp32(variable.reg), general(from, bytes));
  operands.release(value);
  write_through(work, variable);
}

void store_constant(FunctionWork& work, const Location& to, std::uint32_t bytes, std::uint64_t bits) {
  const x86::Mem target = work.operands().memory(to, bytes);
  const auto wide = static_cast<std::int64_t>(bits);
  if (bytes == 1) {
    work.out().mov(target, static_cast<std::int8_t>(bits));
  } else if (bytes == 2) {
    work.out().mov(target, static_cast<std::int16_t>(bits));
  } else if (bytes == 4) {
    work.out().mov(target, static_cast<std::int32_t>(bits));
  } else if (wide == static_cast<std::int32_t>(wide)) {
    work.out().mov(target, wide);
  } else {
    work.out().mov(gp64(kScratch), bits);
    work.out().mov(target, gp64(kScratch));
  }
}

// A Ref that ran out of 32 bits points nowhere.
void store_ref(FunctionWork& work, const Location& to, Value& value) {
  Operands& operands = work.operands();
  operands.settle_flags();
  work.out().mov(gp32(kScratch), bytecode::kNullRef);
  work.out().cmp(gp64(value.reg), gp64(kScratch));
  work.out().cmovb(gp64(kScratch), gp64(value.reg));
  work.out().mov(operands.memory(to, 4), gp32(kScratch));
  operands.release(value);
}

}  // namespace

void store(FunctionWork& work, const Location& to, const MemoryEffect& effect, Value& value) {
  Operands& operands = work.operands();
  if (const Pinned* const variable = work.pinned(effect)) return store_pinned(work, *variable, value);
  const MemType type = effect.type;
  const std::uint32_t bytes = size_of(type);
  check_access(work, to, effect, bytes);
  // The value is read first: what it remembers may be what the store changes.
  const bool constant = value.is(Value::Kind::Constant);
  if (!constant) operands.in_register(value);
  operands.before_write(effect.extent);
  if (constant) return store_constant(work, to, bytes, value.constant);
  if (type == MemType::Ref && !effect.ref_inside) return store_ref(work, to, value);
  const RegisterId reg = value.reg;
  operands.store_register(to, bytes, reg);
  operands.release(value);
  const bool whole = (bytes >= 4 && type != MemType::Ref) || type == MemType::Bool || wrapped(work, type);
  if (whole && effect.extent.is_place_of(bytes)) operands.registers().remember(reg, effect.extent, type);
}

}  // namespace stepwright::native

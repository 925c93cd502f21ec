#include "runtime/native/internal/x86/operands.h"

namespace stepwright::native {

using bytecode::MemType;
namespace x86 = asmjit::x86;

// Reads a load into a register; reuses the index's register where it can.
void Operands::read(Value& value) {
  // Settling the flags may send this very value to its slot, so it comes before anything else.
  const bool changes_flags =
      value.memory == MemType::Bool && (value.bit != bytecode::kNoBit || !value.plain || value.inverted);
  if (changes_flags) settle_flags();
  const Extent where = value.where;
  const bool whole = where.is_place_of(value.bytes()) && value.bit == bytecode::kNoBit;
  const RegisterId known = whole ? registers_.find(where, value.memory) : kNoRegister;
  const bool invert = value.inverted && known != kNoRegister;
  if (known != kNoRegister) {
    if (check_known_ && value.plain) check_known_(value, known);
    registers_.retain(known);
    value = Value::of_register(value.type, known);
    if (!invert) return;
    const RegisterId own = in_own_register(value);
    settle_flags();
    out_.xor_(gp8(own), 1);
    return;
  }
  const RegisterId index = value.location.index;
  const bool reuse = index != kNoRegister && !is_float(value.type) && !registers_.pinned(index) &&
                     registers_.uses(index) == 1;
  const bool remembered = whole && !value.inverted;
  const MemType memory_type = value.memory;
  // Making a register free may send this very value to its slot: it is read from there then.
  const RegisterId reg = reuse ? index : allocate(is_float(value.type));
  registers_.forget(reg);
  read_into(reg, value);
  if (!reuse) release(value);
  value = Value::of_register(value.type, reg);
  if (remembered) registers_.remember(reg, where, memory_type);
}

void Operands::read_into(RegisterId target, Value& value) {
  const x86::Mem from = memory(value.location, value.bytes());
  switch (value.memory) {
    case MemType::Bool:
      return read_bool(target, value);
    case MemType::I8:
    case MemType::I16:
      out_.movsx(gp32(target), from);
      return;
    case MemType::U8:
    case MemType::U16:
      out_.movzx(gp32(target), from);
      return;
    case MemType::I32:
    case MemType::Ref:
      out_.mov(gp32(target), from);
      return;
    case MemType::I64:
      out_.mov(gp64(target), from);
      return;
    case MemType::F32:
      out_.movss(xmm(target), from);
      return;
    case MemType::F64:
      out_.movsd(xmm(target), from);
      return;
  }
}

void Operands::read_bool(RegisterId target, Value& value) {
  const x86::Mem from = memory(value.location, 1);
  if (value.bit == bytecode::kNoBit && value.plain) {
    out_.movzx(gp32(target), from);
    if (!value.inverted) return;
    settle_flags();
    out_.xor_(gp8(target), 1);
    return;
  }
  settle_flags();
  if (value.bit == bytecode::kNoBit) {
    out_.cmp(from, 0);
  } else {
    out_.test(from, 1 << value.bit);
  }
  out_.set(value.inverted ? x86::CondCode::kZero : x86::CondCode::kNotZero, gp8(target));
}

}  // namespace stepwright::native

#include "runtime/native/internal/a64/emitter.h"

namespace stepwright::native::a64 {

using bytecode::MemType;

void Emitter::branch(CondCode condition, asmjit::Label target) {
  if (!far_) {
    out_.b(condition, target);
    return;
  }
  const asmjit::Label over = out_.newLabel();
  out_.b(asmjit::arm::negateCond(condition), over);
  out_.b(target);
  out_.bind(over);
}

void Emitter::constant(const Gp& to, std::uint64_t bits) {
  out_.mov(to, to.isGpW() ? asmjit::Imm(bits & 0xFFFFFFFFu) : asmjit::Imm(bits));
}

void Emitter::compare(const Gp& value, std::uint64_t bits) {
  if (value.isGpW()) bits &= 0xFFFFFFFFu;
  if (bits < 4096) {
    out_.cmp(value, bits);
    return;
  }
  const Gp other = value.isGpW() ? static_cast<Gp>(w(kScratch)) : static_cast<Gp>(x(kScratch));
  constant(other, bits);
  out_.cmp(value, other);
}

void Emitter::add(const GpX& to, const GpX& from, std::uint64_t bytes) {
  if (bytes < 4096) {
    out_.add(to, from, bytes);
    return;
  }
  constant(x(kAddress), bytes);
  out_.add(to, from, x(kAddress));
}

Mem Emitter::memory(const GpX& base, std::uint64_t offset, std::uint32_t bytes) {
  if (offset % bytes == 0 && offset / bytes < 4096) return ptr(base, static_cast<std::int32_t>(offset));
  constant(x(kAddress), offset);
  return ptr(base, x(kAddress));
}

void Emitter::load(RegisterId to, MemType type, const Mem& from, bool plain) {
  switch (type) {
    case MemType::Bool:
      out_.ldrb(w(to), from);
      if (plain) return;
      out_.cmp(w(to), 0);
      out_.cset(w(to), CondCode::kNE);
      return;
    case MemType::I8:
      out_.ldrsb(w(to), from);
      return;
    case MemType::U8:
      out_.ldrb(w(to), from);
      return;
    case MemType::I16:
      out_.ldrsh(w(to), from);
      return;
    case MemType::U16:
      out_.ldrh(w(to), from);
      return;
    case MemType::I32:
    case MemType::Ref:
      out_.ldr(w(to), from);
      return;
    case MemType::I64:
      out_.ldr(x(to), from);
      return;
    case MemType::F32:
      out_.ldr(s(to), from);
      return;
    case MemType::F64:
      out_.ldr(d(to), from);
      return;
  }
}

void Emitter::store(const Mem& to, MemType type, RegisterId from) {
  switch (type) {
    case MemType::Bool:
    case MemType::I8:
    case MemType::U8:
      out_.strb(w(from), to);
      return;
    case MemType::I16:
    case MemType::U16:
      out_.strh(w(from), to);
      return;
    case MemType::I32:
      out_.str(w(from), to);
      return;
    case MemType::I64:
      out_.str(x(from), to);
      return;
    case MemType::F32:
      out_.str(s(from), to);
      return;
    case MemType::F64:
      out_.str(d(from), to);
      return;
    case MemType::Ref:
      constant(x(kScratch), bytecode::kNullRef);
      out_.cmp(x(from), x(kScratch));
      out_.csel(w(kScratch), w(from), w(kScratch), CondCode::kLO);
      out_.str(w(kScratch), to);
      return;
  }
}

void Emitter::load_slot(RegisterId to, const Mem& from) {
  if (is_vector(to)) {
    out_.ldr(d(to), from);
  } else {
    out_.ldr(x(to), from);
  }
}

void Emitter::store_slot(const Mem& to, RegisterId from) {
  if (is_vector(from)) {
    out_.str(d(from), to);
  } else {
    out_.str(x(from), to);
  }
}

}  // namespace stepwright::native::a64

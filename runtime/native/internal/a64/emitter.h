#pragma once

// Instructions that are more than one where an operand does not fit: wide constants, far addresses, far
// branches.

#include <cstdint>

#include "runtime/native/internal/a64/machine.h"

namespace stepwright::native::a64 {

class Emitter {
 public:
  explicit Emitter(Assembler& out) : out_(out) {}

  Assembler& out() { return out_; }

  // A branch with a condition reaches 1 MiB; in a function that may be longer it goes around a plain one.
  void set_far(bool far) { far_ = far; }
  void branch(CondCode condition, asmjit::Label target);

  void constant(const Gp& to, std::uint64_t bits);
  // Compares with a number as unsigned bits of the register's width. Spoils the scratch register.
  void compare(const Gp& value, std::uint64_t bits);
  void add(const GpX& to, const GpX& from, std::uint64_t bytes);

  // An operand for an instruction that reads or writes `bytes` bytes. Spoils the address register.
  Mem memory(const GpX& base, std::uint64_t offset, std::uint32_t bytes);

  // A value of this type; a Bool that is not known to be 0 or 1 becomes so, which spoils the flags.
  void load(RegisterId to, bytecode::MemType type, const Mem& from, bool plain);
  // A Ref that is no address becomes NULL, which spoils flags and scratch register.
  void store(const Mem& to, bytecode::MemType type, RegisterId from);
  // All 64 bits of a slot.
  void load_slot(RegisterId to, const Mem& from);
  void store_slot(const Mem& to, RegisterId from);

 private:
  Assembler& out_;
  bool far_ = false;
};

}  // namespace stepwright::native::a64

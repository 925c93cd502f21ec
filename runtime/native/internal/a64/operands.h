#pragma once

// The operand stack while code is made: constants that nobody needed yet, values in registers, values in
// their slots.
//
// Invariants: every register holds one operand at most; Bools are 0 or 1 and, as I32, have a zero high half;
// an F32 has a zero high half. None of the moves here changes the flags.

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/native/internal/a64/emitter.h"

namespace stepwright::native::a64 {

struct Operand {
  enum class Kind : std::uint8_t { Constant, Register, Slot };

  Kind kind = Kind::Constant;
  bytecode::StackType type = bytecode::StackType::I32;
  RegisterId reg = kNoRegister;
  std::uint32_t slot = 0;  // its place on the stack
  std::uint64_t constant = 0;

  bool is(Kind other) const { return kind == other; }
};

class Operands {
 public:
  // Operands that must leave their registers go to slots from `first_slot` on (bytes behind the context).
  Operands(Emitter& emit, std::uint32_t first_slot) : emit_(emit), first_slot_(first_slot) {}

  std::uint32_t depth() const { return static_cast<std::uint32_t>(stack_.size()); }
  void push_constant(bytecode::StackType type, std::uint64_t bits);
  void push_register(bytecode::StackType type, RegisterId reg);
  // A value that lies in the slot where it belongs.
  void push_slot(bytecode::StackType type);
  Operand pop();
  // The popped value in a register of its own, to be written or released; load it before anything is pushed.
  RegisterId pop_register();
  RegisterId in_register(Operand& popped);
  bytecode::StackType top_type() const { return stack_.back().type; }

  // A register that holds nothing; spills what lies deepest if there is none.
  RegisterId allocate(bool vector);
  void release(RegisterId reg) { used_[reg] = false; }

  // Everything into its slot, for code that other ways lead to.
  void store_all();
  // Saves the registers that a call would overwrite.
  void save_for_call();
  std::vector<bytecode::StackType> types() const;
  // Operands of these types lie in their slots, no register is in use.
  void begin_block(const std::vector<bytecode::StackType>& types);
  Mem slot_memory(std::uint32_t index) { return emit_.memory(kContext, slot_offset(index), kSlotBytes); }
  std::uint64_t slot_offset(std::uint32_t index) const {
    return first_slot_ + std::uint64_t{index} * kSlotBytes;
  }

 private:
  void spill(std::uint32_t index);
  void load_constant(RegisterId to, const Operand& from);

  Emitter& emit_;
  std::uint32_t first_slot_;
  std::vector<Operand> stack_;
  std::array<bool, kRegisterCount> used_{};
};

}  // namespace stepwright::native::a64

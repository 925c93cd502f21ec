#pragma once

// The operand stack while code is made: values that may still be unread, and the registers that hold them.
// Emits the moves that values need, and nothing else.
//
// Invariants: an I32 in a general register has a zero high half; of a Bool only the lowest byte means
// something; at most one value of the stack is in the flags, and it is settled before anything changes them.
// A value that was popped keeps its registers until it is released.

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "runtime/native/internal/x86/constant_pool.h"
#include "runtime/native/internal/x86/registers.h"
#include "runtime/native/internal/x86/value.h"

namespace stepwright::native {

// A variable that a loop keeps in a register.
struct Pinned {
  Extent where;
  bytecode::MemType type = bytecode::MemType::I32;
  RegisterId reg = kNoRegister;
  bool written = false;  // somewhere in the loop: it goes back to memory where the loop is left
};

class Operands {
 public:
  // Operands that must leave their registers go to slots from `first_slot` on (bytes behind the context).
  Operands(asmjit::x86::Assembler& out, ConstantPool& pool, const InstanceRange& instances,
           std::uint32_t first_slot)
      : out_(out), pool_(pool), instances_(instances), first_slot_(first_slot) {}

  // Of checked code (effect_check.h): called where a register is used in place of a load that would give the
  // same.
  using CheckKnown = std::function<void(const Value& load, RegisterId known)>;
  void set_check(CheckKnown check) { check_known_ = std::move(check); }

  Registers& registers() { return registers_; }
  std::uint32_t depth() const { return static_cast<std::uint32_t>(stack_.size()); }
  Value& at(std::uint32_t index) { return stack_[index]; }

  void push(const Value& value) { stack_.push_back(value); }
  Value pop();
  // As pop, but not in the flags.
  Value pop_settled();
  // As pop for a value that is not in the flags, while another may be.
  Value pop_settled_beside_flags();
  void release(const Value& value);

  // A register that nothing uses; makes one free if there is none.
  RegisterId allocate(bool floating);
  // Frees this general register: what the stack keeps there moves away. Taken until it is released.
  void claim(RegisterId id);

  // The value in a register, which may be shared or pinned: not to be written. Coordinates the value.
  RegisterId in_register(Value& value);
  // The value in a register of its own that may be written.
  RegisterId in_own_register(Value& value);
  // The value into exactly this claimed register; releases what it was in.
  void into(RegisterId target, Value& value);
  // Claims the register and moves a popped value there.
  void into_claimed(RegisterId target, Value& value);
  // An operand for an instruction that reads `bytes` bytes: a constant of 32 bits, memory, or a register.
  asmjit::Operand source(Value& value, std::uint32_t bytes);
  // Memory that an SSE instruction may read instead of a register.
  asmjit::Operand float_source(Value& value);
  // A load into a pinned register; a pinned or own register into memory.
  void read_pinned(Value& value, RegisterId target) { read_into(target, value); }
  void store_register(const Location& to, std::uint32_t bytes, RegisterId from);
  bool flags_pending() const { return flags_pending_; }
  // An address as the Ref that the interpreter would have.
  void compute_address(Value& value);

  asmjit::x86::Mem memory(const Location& location, std::uint32_t bytes) const;
  asmjit::x86::Mem constant(std::uint64_t bits, std::uint32_t bytes) { return pool_.at(out_, bits, bytes); }

  // Before bytes change: what the stack has not read yet is read now, remembered copies are dropped.
  void before_write(const Extent& extent);
  // Before a pinned register changes: values that refer to it get a copy.
  void before_pinned_write(RegisterId id);
  // Before an instruction changes the flags.
  void settle_flags();
  void push_flags(asmjit::x86::CondCode condition);

  // Everything into its slot, so that code which other ways lead to finds it there. Constants too.
  void store_all();
  // Saves registers that a call would overwrite to their slots; the rest stays unread.
  void save_for_call();
  // Forgets all registers; operands of these types lie in their slots.
  void begin_block(const std::vector<bytecode::StackType>& types);
  std::vector<bytecode::StackType> types() const;

  // For library calls: the top operand goes to its slot, as a slot of the interpreter; a result comes from
  // the slot that is next.
  void pop_to_slot();
  void push_slot(bytecode::StackType type);
  asmjit::x86::Mem slot_memory_at(std::uint32_t index) const { return memory(slot(index), kSlotBytes); }

 private:
  void read(Value& value);
  void read_into(RegisterId target, Value& value);
  void read_bool(RegisterId target, Value& value);
  void load_constant(const Value& value, RegisterId reg);
  void spill(std::uint32_t index);
  void forget_slot(std::uint32_t index);
  void spill_one(bool floating);
  RegisterId read_scratch(Value& value);
  void address_into(RegisterId target, const Location& location);
  void copy_index(Value& value);
  Location slot(std::uint32_t index) const;
  void move(bytecode::StackType type, RegisterId to, RegisterId from);
  void settle(Value& value);

  asmjit::x86::Assembler& out_;
  ConstantPool& pool_;
  InstanceRange instances_;
  std::uint32_t first_slot_;
  Registers registers_;
  std::vector<Value> stack_;
  bool flags_pending_ = false;
  CheckKnown check_known_;
};

}  // namespace stepwright::native

#pragma once

// Working state of the AArch64 translator for one function, shared by its parts: position, operands, labels,
// traps and what else lies behind the function.
//
// One thread; lives as long as the function is translated.

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/bytecode/trap.h"
#include "runtime/native/internal/a64/operands.h"
#include "runtime/native/internal/program_code.h"

namespace stepwright::native::a64 {

// State that all functions of a program share.
struct ProgramWork {
  const ProgramFacts& facts;
  Assembler& out;
  std::vector<asmjit::Label> functions;
  asmjit::Label trapped;               // with the number of the trap's site in w0
  asmjit::Label refill;                // more budget for the cost in the context; keeps the values' registers
  std::vector<bytecode::Trap>& sites;  // numbered from 1
  std::vector<CallSite>& calls;        // in the order of their offsets
};

class FunctionWork {
 public:
  FunctionWork(ProgramWork& program, std::uint32_t function);
  FunctionWork(const FunctionWork&) = delete;
  FunctionWork& operator=(const FunctionWork&) = delete;

  Assembler& out() { return program_.out; }
  Emitter& emit() { return emit_; }
  Operands& operands() { return operands_; }
  ProgramWork& program() { return program_; }
  const ProgramFacts& facts() const { return program_.facts; }
  const bytecode::ContainerView& view() const { return program_.facts.view(); }
  const FunctionFacts& own() const { return program_.facts.facts(function_); }
  const FunctionCode& code() const { return program_.facts.code(function_); }
  std::uint32_t function() const { return function_; }
  std::uint64_t memory_size() const { return program_.facts.program().memory_size(); }

  // The instruction that is being translated.
  std::uint32_t item() const { return item_; }
  void set_item(std::uint32_t item) { item_ = item; }
  // The next instruction is a conditional jump that nothing else leads to: a comparison leaves its result in
  // the flags for it.
  bool next_is_branch() const;
  void leave_in_flags(CondCode condition) { condition_ = condition; }
  std::optional<CondCode> take_flags();

  // Where to go for a trap of the current instruction, after giving back `refund` of the budget.
  asmjit::Label trap(bytecode::TrapCode code, std::uint32_t refund = 0);
  // The same for a reference, in a general register, that leads out of the memory.
  asmjit::Label reference_trap(RegisterId reference);
  // After result := x op y: if that is no number, the one that the interpreter gives. The three differ.
  void settle_nan(bytecode::StackType type, RegisterId result, RegisterId x, RegisterId y);
  // Takes bytes off the budget, or traps.
  void charge(std::uint32_t bytes);
  // The code of all traps, behind the function.
  void emit_cold();

  // Places as instructions name them.
  Mem absolute(std::uint64_t offset, std::uint32_t bytes) { return emit_.memory(kImage, offset, bytes); }
  Mem of_self(std::uint64_t offset, std::uint32_t bytes) { return emit_.memory(kSelf, offset, bytes); }
  Mem local(std::uint32_t index) { return emit_.memory(kContext, local_offset(index), kSlotBytes); }
  Mem field(std::size_t offset) { return ptr(kContext, static_cast<std::int32_t>(offset)); }
  // Where the running instance is kept during calls.
  Mem saved_self() { return local(code().record.local_count + code().record.max_stack); }
  // True if the BOOL that the current instruction reads can only be 0 or 1.
  bool reads_plain_bool() const;

 private:
  struct Cold {
    asmjit::Label label;
    std::uint32_t site = 0;  // 0: not a trap but a result that is no number
    std::uint32_t refund = 0;
    RegisterId reference = kNoRegister;  // decides between this site and the next
    asmjit::Label back;
    bytecode::StackType type = bytecode::StackType::F32;
    RegisterId result = kNoRegister;
    RegisterId x = kNoRegister;
    RegisterId y = kNoRegister;
    asmjit::Label paid;  // of a charge: where to go on if there is more budget
  };

  std::uint64_t local_offset(std::uint32_t index) const {
    return own().places.first_slot + std::uint64_t{index} * kSlotBytes;
  }
  void emit_trap(const Cold& cold);
  void emit_nan(const Cold& cold);
  void emit_refill(const Cold& cold);
  void take(std::uint32_t bytes);

  ProgramWork& program_;
  std::uint32_t function_;
  Emitter emit_;
  Operands operands_;
  std::uint32_t item_ = 0;
  std::optional<CondCode> condition_;
  std::vector<Cold> cold_;
};

}  // namespace stepwright::native::a64

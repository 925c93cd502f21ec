#pragma once

// Working state of the x86-64 translator for one function, shared by its parts: position, operands, labels,
// traps and the loop that keeps variables in registers.
//
// One thread; lives as long as the function is translated.

#include <cstdint>
#include <utility>
#include <vector>

#include "runtime/bytecode/trap.h"
#include "runtime/native/internal/program_code.h"
#include "runtime/native/internal/x86/loop_plan.h"
#include "runtime/native/internal/x86/operands.h"

namespace stepwright::native {

// State that all functions of a program share.
struct ProgramWork {
  const ProgramFacts& facts;
  asmjit::x86::Assembler& out;
  ConstantPool& pool;
  std::vector<asmjit::Label> functions;
  asmjit::Label trapped;               // with the number of the trap's site in eax
  asmjit::Label refill;                // more budget for the cost in the context; keeps every register
  std::vector<bytecode::Trap>& sites;  // numbered from 1
  std::vector<CallSite>& calls;        // in the order of their offsets
  std::vector<CodePlace>* checks;      // null: the code is not checked (effect_check.h)
};

class FunctionWork {
 public:
  FunctionWork(ProgramWork& program, std::uint32_t function);
  FunctionWork(const FunctionWork&) = delete;
  FunctionWork& operator=(const FunctionWork&) = delete;

  asmjit::x86::Assembler& out() { return program_.out; }
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
  const FunctionCode::Item& current() const { return code().items[item_]; }
  // The next instruction if nothing else leads to it, else null.
  const bytecode::Instruction* next() const;

  const Loop* loop() const { return loop_; }
  void enter_loop(const Loop& loop);
  void leave_loop();
  // The access of the current instruction, or of another one, to memory; requires that it has one.
  const MemoryEffect& effect(bool store) const { return effect_of(item_, store); }
  const MemoryEffect& effect_of(std::uint32_t item, bool store) const {
    return facts().effect(function_, item, store);
  }
  // The variable of the loop that an access with this effect reads or writes, or null: then it touches none.
  const Pinned* pinned(const MemoryEffect& effect) const;
  // Stores the variables that the loop writes, without leaving it.
  void write_back();

  // Where to go for a trap of the current instruction, after giving back `refund` of the budget.
  asmjit::Label trap(bytecode::TrapCode code, std::uint32_t refund = 0);
  // Takes that much off the budget and goes on at `paid`; traps if the budget is used up.
  void charge(std::uint32_t cost, asmjit::Label paid);
  // The same, and goes on behind it.
  void charge(std::uint32_t cost);
  // The same for a reference, in a general register, that leads out of the memory.
  asmjit::Label reference_trap(RegisterId reference);
  // Where to go to leave the loop for that label.
  asmjit::Label leaving(asmjit::Label target);
  // The code of all those, behind the function.
  void emit_cold();

  // Places as instructions name them.
  Location absolute(std::uint32_t offset) const { return {Space::Image, offset, kNoRegister, 0}; }
  Location of_self(std::uint32_t offset) const;
  Location local(std::uint32_t index) const;
  // Where the running instance is kept during calls.
  asmjit::x86::Mem saved_self() const;

  // The register of a loop variable into which the result of this type goes next, or kNoRegister: values
  // that refer to it have been moved away.
  RegisterId destination(bytecode::StackType type);
  // The last such register since this was asked; kNoRegister if there was none.
  RegisterId take_ahead() { return std::exchange(ahead_, kNoRegister); }

 private:
  struct Cold {
    asmjit::Label label;
    const Loop* loop = nullptr;
    asmjit::Label target;  // or a trap, if it is not valid
    std::uint32_t site = 0;
    std::uint32_t refund = 0;
    RegisterId reference = kNoRegister;  // decides between this site and the next
    asmjit::Label paid;                  // of a charge: where to go on if there is more budget
  };

  void write_back(const Loop& loop);
  void emit_refill(const Cold& cold);

  ProgramWork& program_;
  std::uint32_t function_;
  Operands operands_;
  std::uint32_t item_ = 0;
  const Loop* loop_ = nullptr;
  RegisterId ahead_ = kNoRegister;
  std::vector<Cold> cold_;
};

}  // namespace stepwright::native

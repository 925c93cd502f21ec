#pragma once

// One function of the translator per family of instructions; each makes the code of the current instruction.

#include "runtime/bytecode/instruction.h"
#include "runtime/native/internal/x86/function_work.h"

namespace stepwright::native {

// False if the instruction is of another family.
bool translate_memory(FunctionWork& work, const bytecode::Instruction& in);
bool translate_integer(FunctionWork& work, const bytecode::Instruction& in);
bool translate_comparison(FunctionWork& work, const bytecode::Instruction& in);
bool translate_shift(FunctionWork& work, const bytecode::Instruction& in);
bool translate_division(FunctionWork& work, const bytecode::Instruction& in);
bool translate_float(FunctionWork& work, const bytecode::Instruction& in);
bool translate_conversion(FunctionWork& work, const bytecode::Instruction& in);
bool translate_intrinsic(FunctionWork& work, const bytecode::Instruction& in);
bool translate_stack(FunctionWork& work, const bytecode::Instruction& in);
bool translate_call(FunctionWork& work, const bytecode::Instruction& in);
// Instructions whose work is done by a function of the library; intrinsics only if no instructions do it.
bool translate_library(FunctionWork& work, const bytecode::Instruction& in);

// A call with the stack as the platform wants it; the arguments are in their registers.
void call_aligned(asmjit::x86::Assembler& out, std::uint64_t function);

// Makes the code of a whole function, at its label.
void translate_function(ProgramWork& program, std::uint32_t function);

// The place that an address leads to, checked as far as the effect asks for it, before so many bytes there
// are read or written. The value is what holds the place's register, to be released behind the access.
Location place_at(FunctionWork& work, Value& address, const MemoryEffect& effect, std::uint32_t bytes);
// Stores a popped value, which is released.
void store(FunctionWork& work, const Location& to, const MemoryEffect& effect, Value& value);
// Pushes what lies there, not read yet if possible.
void push_load(FunctionWork& work, const Location& from, const MemoryEffect& effect,
               bytecode::StackType slot);

}  // namespace stepwright::native

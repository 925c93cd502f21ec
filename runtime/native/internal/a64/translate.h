#pragma once

// One function of the translator per family of instructions; each makes the code of the current instruction.

#include "runtime/bytecode/instruction.h"
#include "runtime/native/internal/a64/function_work.h"

namespace stepwright::native::a64 {

// False if the instruction is of another family.
bool translate_memory(FunctionWork& work, const bytecode::Instruction& in);
bool translate_boolean(FunctionWork& work, const bytecode::Instruction& in);
bool translate_integer(FunctionWork& work, const bytecode::Instruction& in);
bool translate_shift(FunctionWork& work, const bytecode::Instruction& in);
bool translate_comparison(FunctionWork& work, const bytecode::Instruction& in);
bool translate_float(FunctionWork& work, const bytecode::Instruction& in);
bool translate_conversion(FunctionWork& work, const bytecode::Instruction& in);
bool translate_stack(FunctionWork& work, const bytecode::Instruction& in);
bool translate_call(FunctionWork& work, const bytecode::Instruction& in);
// Instructions whose work is done by a function of the library; intrinsics only if no instructions do it.
bool translate_library(FunctionWork& work, const bytecode::Instruction& in);

// Makes the code of a whole function, at its label.
void translate_function(ProgramWork& program, std::uint32_t function);

// Traps unless `bytes` bytes at that reference lie within the memory.
void check_reference(FunctionWork& work, RegisterId reference, std::uint32_t bytes);

}  // namespace stepwright::native::a64

#pragma once

// The checked form of the code, for tests: instructions that prove, while the program runs, what the loops'
// registers rely on (runtime/doc/native.md). They keep registers and flags and note the first check that
// failed in the context. None of these functions emits anything in the plain form.

#include "runtime/native/internal/x86/function_work.h"

namespace stepwright::native {

// Before an access of so many bytes that goes to memory: they lie within the effect's extent, and none is of
// a variable that the loop keeps in a register, unless both only read.
void check_access(FunctionWork& work, const Location& place, const MemoryEffect& effect, std::uint32_t bytes);

// Before an address is dropped because its effect is one fixed place: the address leads there.
void check_address(FunctionWork& work, Value& address, const MemoryEffect& effect, std::uint32_t bytes);

// Behind a store to a loop's register: memory is kept equal.
void write_through(FunctionWork& work, const Pinned& variable);

// Where a register is used in place of a load: it equals the memory that the load would read.
void check_known(FunctionWork& work, const Value& load, RegisterId known);

// Behind each instruction: the registers of the loop equal the memory of their variables. One into which a
// result has gone ahead of its store is left out until that has been made.
void check_loop(FunctionWork& work);

}  // namespace stepwright::native

#pragma once

// Memory effects: the bytes that each instruction of a function may touch. This is the one place that decides
// it, for every kind of access: the plan of loops, the facts about the program and the translators all ask
// here, so that no two of them can disagree about where an access leads. A pure function; any thread.
//
//   direct (Abs, This, fused BOOLs), bits, locals   their bytes
//   through an address, copies                      what the address is made of: a base, elements, distances;
//                                                   exactly one place for an element known beforehand, also
//                                                   for the only one that an array has
//   an address from memory, from a parameter, from
//   bounds known only when the program runs, or     unknown: any byte of the memory
//   from several ways that meet
//   strings                                         what is written: the longest string at the destination
//   calls                                           nothing here: the callee has effects of its own, and what
//                                                   is kept over a call is none of the memory's values
//
// Invariant: an access touches no byte outside of its extent. The checked form of the code proves it as it
// runs (runtime/doc/native.md).

#include <cstdint>
#include <vector>

#include "runtime/native/internal/extent.h"
#include "runtime/native/internal/function_code.h"

namespace stepwright::native {

struct MemoryEffect {
  std::uint32_t item = 0;  // index of the instruction
  Extent extent;
  bytecode::MemType type = bytecode::MemType::U8;
  bool store = false;
  bool is_value = false;  // a value of this type; else bytes of any (copies, strings), or a bit
  bool inside = false;    // the extent is the function's to use: the access needs no check
  bool fixed = false;     // inside, and always exactly these bytes: they may be read and written at any time
  bool ref_inside = false;  // a store of a Ref that leads to no place behind the memory

  // A variable's own value, as a register can hold it.
  bool is_scalar() const { return is_value && fixed; }
};

// In the order of the instructions; of one the reads come first.
std::vector<MemoryEffect> memory_effects(const bytecode::Program& program, const FunctionCode& code,
                                         const FunctionPlaces& places);

}  // namespace stepwright::native

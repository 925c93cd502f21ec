#pragma once

// The operations of the StringOp instruction. Every engine calls them, so that all give the same texts.
//
// A string's header and capacity are checked against the memory at every use, its length is cut to its
// capacity: whatever bytes a program puts there, nothing outside the memory is read or written. A destination
// that is one of the sources gets the result as if it were computed aside first; one that overlaps a source
// in part, which no typed program can ask for, is a BadReference.

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/bytecode/opcode.h"
#include "runtime/bytecode/trap.h"
#include "runtime/operations/slot.h"

namespace stepwright::operations {

// Replaces the operands below `sp` by the result, if there is one, and takes one unit per character from
// `budget` before it starts. With a trap nothing has changed.
bytecode::TrapCode call_string_op(bytecode::StringOpId id, Slot*& sp, std::span<std::byte> memory,
                                  std::uint64_t& budget);

}  // namespace stepwright::operations

#pragma once

// References that a program follows: checked against the memory each time.

#include <cstdint>

#include "runtime/bytecode/trap.h"
#include "runtime/bytecode/value_type.h"
#include "runtime/operations/slot.h"

namespace stepwright::operations {

// True if `size` bytes at `ref` lie within a memory of `memory_size` bytes.
constexpr bool within(Slot ref, std::uint64_t size, std::uint64_t memory_size) {
  return ref <= memory_size && size <= memory_size - ref;
}

// Why a reference that is not within the memory traps: NULL, with or without an offset, or another address.
constexpr bytecode::TrapCode reference_fault(Slot ref) {
  return ref >= bytecode::kNullRef ? bytecode::TrapCode::NullReference : bytecode::TrapCode::BadReference;
}

}  // namespace stepwright::operations

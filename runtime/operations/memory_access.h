#pragma once

// Loads and stores between the image and the stack, one pair per memory type.

#include "runtime/bytecode/value_type.h"
#include "runtime/operations/slot.h"

namespace stepwright::operations {

template <bytecode::MemType M>
inline Slot load(const std::byte* at) {
  using bytecode::MemType;
  if constexpr (M == MemType::Bool) return to_slot(read_as<std::uint8_t>(at) != 0);
  if constexpr (M == MemType::I8) return to_slot(std::int32_t{read_as<std::int8_t>(at)});
  if constexpr (M == MemType::U8) return read_as<std::uint8_t>(at);
  if constexpr (M == MemType::I16) return to_slot(std::int32_t{read_as<std::int16_t>(at)});
  if constexpr (M == MemType::U16) return read_as<std::uint16_t>(at);
  if constexpr (M == MemType::I32 || M == MemType::F32 || M == MemType::Ref)
    return read_as<std::uint32_t>(at);
  if constexpr (M == MemType::I64 || M == MemType::F64) return read_as<std::uint64_t>(at);
}

template <bytecode::MemType M>
inline void store(std::byte* at, Slot slot) {
  using bytecode::MemType;
  constexpr std::uint32_t kSize = bytecode::size_of(M);
  if constexpr (M == MemType::Ref) {
    // A Ref that ran out of 32 bits points nowhere.
    write_as(at, slot < bytecode::kNullRef ? static_cast<std::uint32_t>(slot) : bytecode::kNullRef);
  } else if constexpr (kSize == 1) {
    write_as(at, static_cast<std::uint8_t>(slot));
  } else if constexpr (kSize == 2) {
    write_as(at, static_cast<std::uint16_t>(slot));
  } else if constexpr (kSize == 4) {
    write_as(at, static_cast<std::uint32_t>(slot));
  } else {
    write_as(at, slot);
  }
}

}  // namespace stepwright::operations

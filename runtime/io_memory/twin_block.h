#pragma once

// Bytes in shared memory with one writer and any readers, without locks: two slots that are written in turn.
// A writer that is killed in the middle leaves the newest complete write; a reader that is overtaken copies
// again.
//
// Threads and processes: one writer at a time; readers anywhere. No heap or system call. Requires memory of
// block_bytes() that is aligned to 64 bytes and zero at first.

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/io_memory/area_format.h"

namespace stepwright::io_memory {

class TwinBlock {
 public:
  TwinBlock(std::byte* memory, std::uint32_t bytes) : memory_(memory), bytes_(bytes) {}

  // Requires as many bytes as the block has.
  void write(const SlotHeader& header, std::span<const std::byte> bytes);

  // The newest write; `bytes` may be shorter than the block. False, and nothing changed, if there was none or
  // a writer was faster than every attempt. Takes as much stack as the bytes are.
  [[nodiscard]] bool read(SlotHeader& header, std::span<std::byte> bytes) const {
    return read(
        header, bytes, [](void*) {}, nullptr);
  }
  // The same with a writer whose turn comes in each attempt, between the copy and the look whether it is
  // whole: what an overtaken reader sees, in tests.
  using WriterTurn = void (*)(void* writer);
  [[nodiscard]] bool read(SlotHeader& header, std::span<std::byte> bytes, WriterTurn turn,
                          void* writer) const;

  // There was a write: a read that fails was overtaken.
  bool written() const;

 private:
  std::byte* memory_;
  std::uint32_t bytes_;
};

}  // namespace stepwright::io_memory

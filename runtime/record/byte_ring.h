#pragma once

// Records on their way from the scan thread to the thread that writes them: a bounded ring of bytes in which
// each record stands behind its length. Memory is taken once.
//
//   ByteRing ring(4u << 20);
//   if (!ring.push({head, image})) ...                 // producer: whole, or not at all
//   while (ring.pop(record)) ...                       // consumer
//
// Threads: one producer, one consumer, no locks; neither waits. The producer needs no heap.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace stepwright::record {

class ByteRing {
 public:
  explicit ByteRing(std::size_t capacity) : bytes_(capacity) {}

  // Producer: one record from its parts. False, and nothing is pushed, if there is no room for it.
  bool push(std::initializer_list<std::span<const std::byte>> parts);
  // Producer: bytes that a record may have now.
  std::size_t room() const;

  // Consumer: the oldest record in place of what was in `record`; false if there is none.
  bool pop(std::vector<std::byte>& record);

  std::size_t capacity() const { return bytes_.size(); }

 private:
  using Length = std::uint32_t;
  void copy_in(std::uint64_t at, std::span<const std::byte> from);
  void copy_out(std::uint64_t at, std::span<std::byte> to) const;

  std::vector<std::byte> bytes_;
  // Bytes ever pushed and popped; the place in the ring is the rest of a division.
  alignas(64) std::atomic<std::uint64_t> pushed_{0};
  alignas(64) std::atomic<std::uint64_t> popped_{0};
};

}  // namespace stepwright::record

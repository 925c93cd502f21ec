#include "runtime/io_memory/twin_block.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

namespace stepwright::io_memory {
namespace {

constexpr int kAttempts = 16;
using Word = std::uint64_t;

Word& word_at(std::byte* memory) {
  return *reinterpret_cast<Word*>(memory);
}

// Each word is a release: whoever sees one of them sees that the write before it was complete.
void store_words(std::byte* to, const void* from, std::size_t size) {
  const auto* source = static_cast<const std::byte*>(from);
  for (std::size_t at = 0; at < size; at += sizeof(Word)) {
    Word word = 0;
    std::memcpy(&word, source + at, std::min(sizeof word, size - at));
    std::atomic_ref(word_at(to + at)).store(word, std::memory_order_release);
  }
}

void load_words(void* to, std::byte* from, std::size_t size) {
  auto* target = static_cast<std::byte*>(to);
  for (std::size_t at = 0; at < size; at += sizeof(Word)) {
    const Word word = std::atomic_ref(word_at(from + at)).load(std::memory_order_acquire);
    std::memcpy(target + at, &word, std::min(sizeof word, size - at));
  }
}

std::atomic<std::uint64_t>& count_of(std::byte* memory) {
  return reinterpret_cast<BlockHeader*>(memory)->count;
}

std::byte* slot_of(std::byte* memory, std::uint64_t count, std::uint32_t bytes) {
  return memory + kBlockHeaderBytes + (count % 2) * slot_bytes(bytes);
}

}  // namespace

void TwinBlock::write(const SlotHeader& header, std::span<const std::byte> bytes) {
  assert(bytes.size() == bytes_);
  std::atomic<std::uint64_t>& count = count_of(memory_);
  const std::uint64_t next = count.load(std::memory_order_relaxed) + 1;
  std::byte* const slot = slot_of(memory_, next, bytes_);
  store_words(slot, &header, sizeof header);
  store_words(slot + sizeof header, bytes.data(), bytes.size());
  count.store(next, std::memory_order_release);
}

bool TwinBlock::read(SlotHeader& header, std::span<std::byte> bytes, WriterTurn turn, void* writer) const {
  assert(bytes.size() <= bytes_ && bytes_ <= kMaxAreaBytes);
  const std::atomic<std::uint64_t>& count = count_of(memory_);
  // What is overtaken must not be seen: the caller's bytes are written once the copy is known to be whole.
  SlotHeader head;
  std::array<std::byte, kMaxAreaBytes> whole;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::uint64_t newest = count.load(std::memory_order_acquire);
    if (newest == 0) return false;
    std::byte* const slot = slot_of(memory_, newest, bytes_);
    load_words(&head, slot, sizeof head);
    load_words(whole.data(), slot + sizeof head, bytes.size());
    turn(writer);
    // The slot is written again only after another count.
    if (count.load(std::memory_order_relaxed) != newest) continue;
    header = head;
    std::copy_n(whole.begin(), bytes.size(), bytes.begin());
    return true;
  }
  return false;
}

bool TwinBlock::written() const {
  return count_of(memory_).load(std::memory_order_acquire) != 0;
}

}  // namespace stepwright::io_memory

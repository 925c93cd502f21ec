#pragma once

// The newest block of bytes, from one thread to another without a lock and without waiting: three blocks, of
// which the writer owns one, the reader one, and the third changes hands.
//
// Threads: `back` and `publish` belong to one thread, `take` and `front` to another. Memory is taken once.
//
//   fill(buffer.back());  buffer.publish(17);          // writer
//   if (buffer.take()) use(buffer.front());            // reader; false if nothing is newer

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stepwright::record {

class TripleBuffer {
 public:
  explicit TripleBuffer(std::size_t bytes = 0) : size_(bytes), memory_(3 * bytes) {}

  std::span<std::byte> back() { return block(back_); }
  // `number` goes with the block.
  void publish(std::uint64_t number) {
    numbers_[back_] = number;
    back_ = shared_.exchange(back_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  bool take() {
    if ((shared_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    front_ = shared_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  std::span<const std::byte> front() { return block(front_); }
  std::uint64_t number() const { return numbers_[front_]; }

 private:
  static constexpr std::uint32_t kIndex = 3;
  static constexpr std::uint32_t kFresh = 4;

  std::span<std::byte> block(std::uint32_t index) { return std::span(memory_).subspan(index * size_, size_); }

  std::size_t size_;
  std::vector<std::byte> memory_;
  std::array<std::uint64_t, 3> numbers_{};
  std::uint32_t back_ = 0;
  alignas(64) std::atomic<std::uint32_t> shared_{1};
  alignas(64) std::uint32_t front_ = 2;
};

}  // namespace stepwright::record

#pragma once

// Bytes between an interrupt and the main loop: one writes, the other reads.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace stepwright::boards {

class ByteQueue {
 public:
  bool empty() const {
    return head_.load(std::memory_order_acquire) == tail_.load(std::memory_order_acquire);
  }

  // False if it is full.
  bool push(std::byte byte) {
    const std::uint32_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == bytes_.size()) return false;
    bytes_[head % bytes_.size()] = byte;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }
  // False if it is empty.
  bool pop(std::byte& byte) {
    const std::uint32_t tail = tail_.load(std::memory_order_relaxed);
    if (head_.load(std::memory_order_acquire) == tail) return false;
    byte = bytes_[tail % bytes_.size()];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

 private:
  std::array<std::byte, 512> bytes_{};  // two frames
  std::atomic<std::uint32_t> head_{0};
  std::atomic<std::uint32_t> tail_{0};
};

}  // namespace stepwright::boards

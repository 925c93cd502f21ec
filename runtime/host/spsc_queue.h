#pragma once

// A bounded queue between one producer thread and one consumer thread, without locks. Memory is taken once.
//
//   SpscQueue<Command> commands(256);
//   if (!commands.push(command)) ...                  // producer
//   while (auto command = commands.pop()) ...         // consumer

#include <atomic>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace stepwright::host {

template <typename T>
class SpscQueue {
 public:
  explicit SpscQueue(std::size_t capacity) : slots_(capacity + 1) {}

  // False if the queue is full; `value` is then unchanged.
  bool push(T&& value) {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    const std::size_t next = after(tail);
    if (next == head_.load(std::memory_order_acquire)) return false;
    slots_[tail] = std::move(value);
    tail_.store(next, std::memory_order_release);
    return true;
  }

  std::optional<T> pop() {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return std::nullopt;
    std::optional<T> value(std::move(slots_[head]));
    head_.store(after(head), std::memory_order_release);
    return value;
  }

 private:
  std::size_t after(std::size_t index) const { return index + 1 == slots_.size() ? 0 : index + 1; }

  std::vector<T> slots_;  // one stays empty, so that full and empty differ
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace stepwright::host

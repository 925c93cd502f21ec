#pragma once

// The board's memory for programs, handed out from its beginning; given back as a whole only.
//
//   Arena arena(board.memory);
//   const std::span<std::byte> image = arena.take<std::byte>(size);   // empty if it does not fit

#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::app {

class Arena {
 public:
  // Requires memory that is aligned to kAlignment.
  explicit Arena(std::span<std::byte> memory) : memory_(memory) {}

  static constexpr std::size_t kAlignment = 8;
  static constexpr std::uint64_t rounded(std::uint64_t bytes) {
    return (bytes + kAlignment - 1) / kAlignment * kAlignment;
  }

  std::size_t size() const { return memory_.size(); }

  // The memory that has not been handed out.
  template <typename T = std::byte>
  std::span<T> rest() const {
    return {reinterpret_cast<T*>(memory_.data() + used_), (memory_.size() - used_) / sizeof(T)};
  }

  // Requires room for it.
  template <typename T>
  std::span<T> take(std::size_t count) {
    const std::span<T> taken = rest<T>().first(count);
    used_ += static_cast<std::size_t>(rounded(count * sizeof(T)));
    return taken;
  }

  void reset() { used_ = 0; }

 private:
  std::span<std::byte> memory_;
  std::size_t used_ = 0;
};

}  // namespace stepwright::app

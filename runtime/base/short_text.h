#pragma once

// A text of a few characters by value, for numbers and times: no heap.

#include <array>
#include <cassert>
#include <cstdint>
#include <span>

namespace stepwright::base {

class ShortText {
 public:
  static constexpr std::size_t kCapacity = 64;

  // Requires room for it.
  void push(char c) {
    assert(size_ < kCapacity);
    chars_[size_++] = c;
  }
  // Text up to its terminating zero.
  void push(const char* text) {
    for (; *text != '\0'; ++text) push(*text);
  }
  // Decimal, with zeros in front up to `width` digits.
  void push_number(std::uint64_t value, std::uint32_t width = 1) {
    if (value >= 10 || width > 1) push_number(value / 10, width > 1 ? width - 1 : 1);
    push(static_cast<char>('0' + value % 10));
  }

  std::span<const char> view() const { return std::span(chars_).first(size_); }

 private:
  std::array<char, kCapacity> chars_{};
  std::size_t size_ = 0;
};

}  // namespace stepwright::base

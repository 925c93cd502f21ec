#pragma once

// A natural number of up to 2176 bits: what exact conversion between binary and decimal takes (10^574 times a
// digit at most). No heap; small rather than fast.

#include <array>
#include <bit>
#include <cstdint>

namespace stepwright::decimal {

class BigNumber {
 public:
  explicit BigNumber(std::uint64_t value = 0) {
    words_[0] = static_cast<std::uint32_t>(value);
    words_[1] = static_cast<std::uint32_t>(value >> 32);
    size_ = words_[1] != 0 ? 2 : (words_[0] != 0 ? 1 : 0);
  }

  bool zero() const { return size_ == 0; }

  // Position of the highest bit plus one; 0 of zero.
  int bits() const { return size_ == 0 ? 0 : size_ * 32 - std::countl_zero(words_[at(size_ - 1)]); }

  // this = this * factor + more.
  void multiply(std::uint32_t factor, std::uint32_t more = 0) {
    std::uint64_t carry = more;
    for (int i = 0; i < size_; ++i) {
      carry += std::uint64_t{words_[at(i)]} * factor;
      words_[at(i)] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) words_[at(size_++)] = static_cast<std::uint32_t>(carry);
  }

  void multiply_by_power_of_ten(int exponent) {
    for (; exponent >= 9; exponent -= 9) multiply(1'000'000'000);
    for (; exponent > 0; --exponent) multiply(10);
  }

  void shift_left(int count) {
    if (size_ == 0) return;
    for (; count >= 32; count -= 32) {
      for (int i = size_; i > 0; --i) words_[at(i)] = words_[at(i - 1)];
      words_[0] = 0;
      ++size_;
    }
    multiply(std::uint32_t{1} << count);
  }

  // Requires other <= this.
  void subtract(const BigNumber& other) {
    std::int64_t carry = 0;
    for (int i = 0; i < size_; ++i) {
      carry += std::int64_t{words_[at(i)]} - (i < other.size_ ? other.words_[at(i)] : 0);
      words_[at(i)] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    while (size_ > 0 && words_[at(size_ - 1)] == 0) --size_;
  }

  void add(const BigNumber& other) {
    std::uint64_t carry = 0;
    for (int i = 0; i < size_ || i < other.size_ || carry != 0; ++i) {
      if (i >= size_) words_[at(size_++)] = 0;
      carry += std::uint64_t{words_[at(i)]} + (i < other.size_ ? other.words_[at(i)] : 0);
      words_[at(i)] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }

  // -1, 0 or 1: less than, equal to, greater than the other.
  int compare(const BigNumber& other) const {
    if (size_ != other.size_) return size_ < other.size_ ? -1 : 1;
    for (int i = size_ - 1; i >= 0; --i) {
      if (words_[at(i)] != other.words_[at(i)]) return words_[at(i)] < other.words_[at(i)] ? -1 : 1;
    }
    return 0;
  }

 private:
  static constexpr std::size_t at(int index) { return static_cast<std::size_t>(index); }

  std::array<std::uint32_t, 68> words_;
  int size_ = 0;
};

}  // namespace stepwright::decimal

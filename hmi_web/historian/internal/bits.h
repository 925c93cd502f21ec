#pragma once

// Bits, most significant first, and Rice codes of numbers that are mostly small. The reader trusts nobody: a
// read beyond the end gives zeros and is remembered.
//
// Not thread-safe.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stepwright::historian::internal {

// Small negative numbers become small numbers: 0, -1, 1, -2 ... -> 0, 1, 2, 3 ...
constexpr std::uint64_t zigzag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ (value < 0 ? ~std::uint64_t{0} : 0);
}
constexpr std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>((value >> 1) ^ (0 - (value & 1)));
}

// A Rice code of parameter k: the number without its lowest k bits as so many ones and a zero, then these k
// bits. From kLongestUnary on instead: kLongestUnary ones, six bits with its width - 1, its bits.
inline constexpr unsigned kLongestUnary = 10;

constexpr unsigned width_of(std::uint64_t value) {
  return value == 0 ? 1U : static_cast<unsigned>(std::bit_width(value));
}

class BitWriter {
 public:
  explicit BitWriter(std::vector<std::byte>& out) : out_(out) {}

  // The lowest `count` bits, 0 to 64 of them.
  void put(std::uint64_t bits, unsigned count) {
    if (count > 32) {
      put(bits >> 32, count - 32);
      count = 32;
    }
    if (count == 0) return;
    held_ = held_ << count | (bits & ((std::uint64_t{1} << count) - 1));
    held_count_ += count;
    while (held_count_ >= 8) {
      held_count_ -= 8;
      out_.push_back(static_cast<std::byte>(held_ >> held_count_));
    }
  }

  void put_rice(std::uint64_t value, unsigned k) {
    const std::uint64_t quotient = value >> k;
    if (quotient < kLongestUnary) {
      const auto ones = static_cast<unsigned>(quotient);
      put(((std::uint64_t{1} << ones) - 1) << 1, ones + 1);
      put(value, k);
      return;
    }
    put((std::uint64_t{1} << kLongestUnary) - 1, kLongestUnary);
    put(width_of(value) - 1, 6);
    put(value, width_of(value));
  }

  // Fills the last byte with zeros.
  void finish() {
    if (held_count_ > 0) put(0, 8 - held_count_);
  }

 private:
  std::vector<std::byte>& out_;
  std::uint64_t held_ = 0;
  unsigned held_count_ = 0;  // below 8 between calls
};

class BitReader {
 public:
  explicit BitReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }

  std::uint64_t get(unsigned count) {
    if (count > 32) {
      const std::uint64_t high = get(count - 32);
      return high << 32 | get(32);
    }
    if (count == 0) return 0;
    refill();
    if (held_count_ < count) {
      ok_ = false;
      held_count_ = 0;
      return 0;
    }
    const std::uint64_t bits = held_ >> (64 - count);
    skip(count);
    return bits;
  }

  // Drops the rest of a byte that was begun.
  void align() { skip(held_count_ % 8); }

  std::uint64_t get_rice(unsigned k) {
    refill();
    const auto ones = static_cast<unsigned>(std::countl_one(held_));
    if (ones >= kLongestUnary) {
      if (held_count_ < kLongestUnary) return fail();
      skip(kLongestUnary);
      const auto width = static_cast<unsigned>(get(6)) + 1;
      return get(width);
    }
    if (held_count_ <= ones) return fail();
    skip(ones + 1);
    return static_cast<std::uint64_t>(ones) << k | get(k);
  }

 private:
  // Bits of `held_` below the valid ones are zero.
  void refill() {
    while (held_count_ <= 56 && position_ < bytes_.size()) {
      held_ |= std::to_integer<std::uint64_t>(bytes_[position_++]) << (56 - held_count_);
      held_count_ += 8;
    }
  }
  void skip(unsigned count) {
    held_ <<= count;
    held_count_ -= count;
  }
  std::uint64_t fail() {
    ok_ = false;
    return 0;
  }

  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
  std::uint64_t held_ = 0;  // the next bits, from the top
  unsigned held_count_ = 0;
  bool ok_ = true;
};

// How often numbers of each width come, to choose the parameter of their Rice codes.
class WidthCounts {
 public:
  void add(std::uint64_t value) { ++counts_[width_of(value) - 1]; }

  // The parameter with the shortest codes, judged by the middle of each width.
  unsigned best_rice() const {
    std::uint64_t least = ~std::uint64_t{0};
    unsigned best = 0;
    for (unsigned k = 0; k < 48; ++k) {
      const std::uint64_t bits = cost(k);
      if (bits < least) {
        least = bits;
        best = k;
      }
    }
    return best;
  }

 private:
  std::uint64_t cost(unsigned k) const {
    std::uint64_t bits = 0;
    for (unsigned width = 1; width <= 64; ++width) {
      if (counts_[width - 1] == 0) continue;
      // 0 and 1 share the width 1; from 2 on, the middle of the width is 1.5 times its least number.
      const std::uint64_t middle = width == 1 ? 0 : (std::uint64_t{3} << (width - 1)) >> 1;
      const std::uint64_t quotient = middle >> k;
      bits += counts_[width - 1] * (quotient < kLongestUnary ? quotient + 1 + k : kLongestUnary + 6 + width);
    }
    return bits;
  }

  std::uint32_t counts_[64] = {};
};

}  // namespace stepwright::historian::internal

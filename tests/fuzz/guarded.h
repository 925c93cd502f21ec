#pragma once

// Elements between two bands whose pattern must stay: a write beside them shows without a sanitizer.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stepwright::fuzz {

template <typename T>
class Guarded {
 public:
  // `size` elements of value zero.
  explicit Guarded(std::size_t size) : all_(size + 2 * kBand, kPattern) {
    std::fill(all_.begin() + kBand, all_.end() - kBand, T{});
  }

  std::span<T> inner() { return std::span(all_).subspan(kBand, all_.size() - 2 * kBand); }

  bool intact() const {
    const auto untouched = [](T value) { return value == kPattern; };
    return std::all_of(all_.begin(), all_.begin() + kBand, untouched) &&
           std::all_of(all_.end() - kBand, all_.end(), untouched);
  }

 private:
  static constexpr std::ptrdiff_t kBand = 4096 / sizeof(T);
  static constexpr T kPattern = static_cast<T>(0xA5A5A5A5A5A5A5A5u);
  std::vector<T> all_;
};

}  // namespace stepwright::fuzz

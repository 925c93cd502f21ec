#include <bit>

#include "hmi_web/historian/internal/values.h"

// After Pelkonen et al., "Gorilla: A Fast, Scalable, In-Memory Time Series Database" (VLDB 2015), section
// 4.1.2, with six bits for the zeros in front.

namespace stepwright::historian::internal {
namespace {

// The bits of a difference that are written: between its zeros in front and behind.
struct Window {
  unsigned leading = 64;
  unsigned width = 0;
  unsigned trailing() const { return 64 - leading - width; }
};

}  // namespace

void write_xor(std::span<const double> values, BitWriter& out) {
  std::uint64_t before = 0;
  Window window;
  for (const double value : values) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const std::uint64_t difference = bits ^ before;
    before = bits;
    if (difference == 0) {
      out.put(0, 1);
      continue;
    }
    const auto leading = static_cast<unsigned>(std::countl_zero(difference));
    const auto trailing = static_cast<unsigned>(std::countr_zero(difference));
    const unsigned width = 64 - leading - trailing;
    const bool fits = window.width > 0 && leading >= window.leading && trailing >= window.trailing();
    if (fits && window.width < width + 12) {  // naming another window costs 12 bits
      out.put(2, 2);
    } else {
      window = {leading, width};
      out.put(3, 2);
      out.put(leading, 6);
      out.put(width - 1, 6);
    }
    out.put(difference >> window.trailing(), window.width);
  }
}

bool read_xor(BitReader& in, std::span<double> values) {
  std::uint64_t bits = 0;
  Window window;
  for (double& value : values) {
    if (in.get(1) != 0) {
      if (in.get(1) != 0) {
        window.leading = static_cast<unsigned>(in.get(6));
        window.width = static_cast<unsigned>(in.get(6)) + 1;
        if (window.leading + window.width > 64) return false;
      }
      if (window.width == 0) return false;
      bits ^= in.get(window.width) << window.trailing();
    }
    value = std::bit_cast<double>(bits);
  }
  return in.ok();
}

}  // namespace stepwright::historian::internal

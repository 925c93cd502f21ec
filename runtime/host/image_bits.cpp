#include "runtime/host/image_bits.h"

#include <array>
#include <bit>

#include "runtime/host/limits.h"

namespace stepwright::host {

std::optional<image::Force> to_force(const ImageBits& bits) {
  if (std::popcount(bits.mask) == 1) {
    const auto place = static_cast<std::uint32_t>(std::countr_zero(bits.mask));
    if (bits.byte_offset > kMaxImageBytes) return std::nullopt;
    const std::uint64_t value = (bits.value >> place) & 1u;
    return image::Force{bits.byte_offset + place / 8, static_cast<std::uint8_t>(place % 8), 1, value};
  }
  for (const std::uint8_t size : std::array<std::uint8_t, 4>{1, 2, 4, 8}) {
    const std::uint64_t whole = size == 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << 8 * size) - 1;
    if (bits.mask == whole)
      return image::Force{bits.byte_offset, image::kWholeBytes, size, bits.value & whole};
  }
  return std::nullopt;
}

}  // namespace stepwright::host

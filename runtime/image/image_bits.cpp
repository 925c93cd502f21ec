#include "runtime/image/image_bits.h"

#include <bit>

namespace stepwright::image {
namespace {

// The mask of so many whole bytes; `size` is 1 to 8.
std::uint64_t whole_bytes(std::uint8_t size) {
  return ~std::uint64_t{0} >> (64 - 8 * size);
}

}  // namespace

std::size_t reach_of(const ImageBits& bits) {
  return static_cast<std::size_t>(std::bit_width(bits.mask) + 7) / 8;
}

bool within(const ImageBits& bits, std::size_t image_bytes) {
  const std::size_t bytes = reach_of(bits);
  return bytes != 0 && bits.byte_offset <= image_bytes && bytes <= image_bytes - bits.byte_offset;
}

BitsStatus write_bits(std::span<std::byte> image, const ImageBits& bits) {
  if (!within(bits, image.size())) return BitsStatus::OutOfBounds;
  const std::size_t bytes = reach_of(bits);
  for (std::size_t i = 0; i < bytes; ++i) {
    const auto mask = static_cast<std::byte>(bits.mask >> (8 * i));
    const auto value = static_cast<std::byte>(bits.value >> (8 * i));
    std::byte& cell = image[bits.byte_offset + i];
    cell = (cell & ~mask) | (value & mask);
  }
  return BitsStatus::Done;
}

BitsStatus to_force(const ImageBits& bits, std::size_t image_bytes, Force& force) {
  if (!within(bits, image_bytes)) return BitsStatus::OutOfBounds;
  if (std::has_single_bit(bits.mask)) {
    const auto place = static_cast<std::uint32_t>(std::countr_zero(bits.mask));
    force = {bits.byte_offset + place / 8, static_cast<std::uint8_t>(place % 8), 1, bits.value >> place & 1};
    return BitsStatus::Done;
  }
  for (std::uint8_t size = 1; size <= 8; size = static_cast<std::uint8_t>(size * 2)) {
    if (bits.mask != whole_bytes(size)) continue;
    force = {bits.byte_offset, kWholeBytes, size, bits.value & bits.mask};
    return BitsStatus::Done;
  }
  return BitsStatus::OutOfBounds;
}

BitsStatus set_force(ForceTable& forces, const Force& force, std::size_t image_bytes) {
  return forces.set(force, image_bytes) ? BitsStatus::Done : BitsStatus::ForcesFull;
}

BitsStatus clear_force(ForceTable& forces, const Force& force) {
  return forces.clear(force.address, force.bit) ? BitsStatus::Done : BitsStatus::NotForced;
}

ImageBits bits_of(const Force& force) {
  if (force.bit != kWholeBytes)
    return {force.address, std::uint64_t{1} << force.bit, (force.value & 1) << force.bit};
  return {force.address, whole_bytes(force.size), force.value};
}

}  // namespace stepwright::image

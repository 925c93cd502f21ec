#include "firmware/app/image_bits.h"

#include <bit>

namespace stepwright::app {
namespace {

using modbus::control::Refusal;

// False if the mask cannot be forced.
bool to_force(const ImageBits& bits, image::Force& force) {
  if (bits.byte > 0x7FFF'FFFF) return false;
  const auto place = static_cast<std::uint32_t>(std::countr_zero(bits.mask));
  if (std::has_single_bit(bits.mask)) {
    force = {bits.byte + place / 8, static_cast<std::uint8_t>(place % 8), 1, bits.value >> place & 1};
    return true;
  }
  for (std::uint8_t size = 1; size <= 8; size = static_cast<std::uint8_t>(size * 2)) {
    const std::uint64_t whole = ~std::uint64_t{0} >> (64 - 8 * size);
    if (bits.mask != whole) continue;
    force = {bits.byte, image::kWholeBytes, size, bits.value & whole};
    return true;
  }
  return false;
}

}  // namespace

Refusal write_bits(std::span<std::byte> image, const ImageBits& bits) {
  const auto bytes = static_cast<std::size_t>(std::bit_width(bits.mask) + 7) / 8;
  if (bytes == 0 || bits.byte > image.size() || bytes > image.size() - bits.byte) return Refusal::OutOfBounds;
  for (std::size_t i = 0; i < bytes; ++i) {
    const auto mask = static_cast<std::byte>(bits.mask >> (8 * i));
    const auto value = static_cast<std::byte>(bits.value >> (8 * i));
    std::byte& cell = image[bits.byte + i];
    cell = (cell & ~mask) | (value & mask);
  }
  return Refusal::Done;
}

Refusal force_bits(image::ForceTable& forces, std::size_t image_size, const ImageBits& bits) {
  image::Force force;
  if (!to_force(bits, force)) return Refusal::OutOfBounds;
  if (forces.set(force, image_size)) return Refusal::Done;
  const bool full = forces.forces().size() == image::ForceTable::kCapacity;
  const bool inside = std::uint64_t{force.address} + force.size <= image_size;
  return full && inside ? Refusal::ForcesFull : Refusal::OutOfBounds;
}

Refusal unforce_bits(image::ForceTable& forces, const ImageBits& bits) {
  image::Force force;
  if (!to_force(bits, force)) return Refusal::OutOfBounds;
  return forces.clear(force.address, force.bit) ? Refusal::Done : Refusal::NotForced;
}

}  // namespace stepwright::app

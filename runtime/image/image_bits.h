#pragma once

// Bits of an image that somebody outside the program writes or forces: what a request names, judged and
// carried out in one way on the host, on a controller without an operating system, and in the gateway that
// stands between them.
//
// Thread rule: pure but for the image and the table that are passed in; those belong to the scan thread.
// Invariants: what is refused changes nothing. The bound of a request is the size of the image that it is
// about and nothing else: a limit of its own would either refuse what a larger image has, or let through what
// a smaller one has not. Within that bound no address leaves 32 bits, since no image is larger.
//
//   if (image::write_bits(bytes, {8, 0xFFFF, 1234}) == image::BitsStatus::OutOfBounds) ...   // a WORD
//   image::Force force;
//   if (image::to_force({8, 0x02, 0x02}, bytes.size(), force) == image::BitsStatus::Done)    // one bit
//     image::set_force(forces, force, bytes.size());

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/image/force_table.h"

namespace stepwright::image {

// Up to 64 bits of the image, little-endian from `byte_offset`: the bits set in `mask` take those of `value`.
// {8, 0x01, 0x01} sets bit 0 of byte 8; {8, 0xFFFF, 1234} a WORD at bytes 8 and 9. A mask that reaches past
// the image, or is 0, is refused.
struct ImageBits {
  std::uint32_t byte_offset = 0;
  std::uint64_t mask = 0;
  std::uint64_t value = 0;

  friend bool operator==(const ImageBits&, const ImageBits&) = default;
};

enum class BitsStatus : std::uint8_t {
  Done,
  OutOfBounds,  // beyond the image, a mask of 0, or one that cannot be forced
  ForcesFull,
  NotForced,
};

// How many bytes from its offset the mask reaches: 1 to 8, 0 for a mask of 0.
std::size_t reach_of(const ImageBits& bits);

// Whether there is a mask and it ends within the image.
bool within(const ImageBits& bits, std::size_t image_bytes);

// Any mask; bits outside it stay.
BitsStatus write_bits(std::span<std::byte> image, const ImageBits& bits);

// The force that bits stand for: a mask of one bit, or of 1, 2, 4 or 8 whole bytes. Any other, and one that
// is not within the image, is OutOfBounds, and `force` is left as it was.
BitsStatus to_force(const ImageBits& bits, std::size_t image_bytes, Force& force);

// Of a force that to_force made for an image of the same size; its value may have been changed since.
BitsStatus set_force(ForceTable& forces, const Force& force, std::size_t image_bytes);
BitsStatus clear_force(ForceTable& forces, const Force& force);

// The bits that a force holds, and what it holds them to: the inverse of to_force.
ImageBits bits_of(const Force& force);

}  // namespace stepwright::image

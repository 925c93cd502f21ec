#pragma once

// Values between the registers of a slave and the bytes of the process image. Pure; no heap; any thread.
//
// Whole numbers without a scale stay whole numbers, all 64 bits of them; everything else is computed in
// double. What the target cannot hold is held at its end, and said.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/modbus/client/tag.h"

namespace stepwright::modbus::client {

// The bits of a value as the image has them; in the low bits_of(type).
struct ImageValue {
  std::uint64_t bits = 0;
  bool exceeded = false;      // held at a limit
  bool not_a_number = false;  // `bits` is of no use: a program goes on better with the value before
};

// `words` as they came, tag.count() of them; of a bit table one word, 0 or 1.
ImageValue to_image(const Tag& tag, std::span<const std::uint16_t> words);

struct WireValue {
  std::array<std::uint16_t, 4> words{};  // tag.count() of them; a bit as 0 or 1
  bool exceeded = false;
};

WireValue to_wire(const Tag& tag, std::uint64_t image_bits);

// The bits of a number in the image's form, held at the type's ends.
std::uint64_t image_bits_of(ImageType type, double value);
// For people and machines: what the bits say.
double number_of(ImageType type, std::uint64_t bits);

// Requires a field within the area.
std::uint64_t get_field(std::span<const std::byte> area, const ImageField& field);
void put_field(std::span<std::byte> area, const ImageField& field, std::uint64_t bits);

}  // namespace stepwright::modbus::client

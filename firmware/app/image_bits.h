#pragma once

// Bits of the image that somebody writes or forces from outside, as the commands name them.

#include <cstdint>
#include <span>

#include "runtime/image/force_table.h"
#include "runtime/modbus/control/registers.h"

namespace stepwright::app {

// Bit i of mask and value is bit i % 8 of byte `byte` + i / 8.
struct ImageBits {
  std::uint32_t byte = 0;
  std::uint64_t mask = 0;
  std::uint64_t value = 0;
};

// As the runtime on the host does it: a mask of one bit or of 1, 2, 4 or 8 whole bytes can be forced, any
// mask can be written. Nothing changes if they are refused.
modbus::control::Refusal write_bits(std::span<std::byte> image, const ImageBits& bits);
modbus::control::Refusal force_bits(image::ForceTable& forces, std::size_t image_size, const ImageBits& bits);
modbus::control::Refusal unforce_bits(image::ForceTable& forces, const ImageBits& bits);

}  // namespace stepwright::app

#pragma once

// Where a value lies in the process image and how it is read out of a copy of it.
//
//   std::optional<double> counts = read({2, 0, ImageType::I16}, snapshot.image);
//
// Pure; any thread. A location past the end of the image gives no value.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace stepwright::server {

// As values lie in the image, little-endian (runtime/doc/bytecode_format.md). Bit is one bit of a byte, Bool a
// byte that is 0 or 1.
enum class ImageType : std::uint8_t { Bit, Bool, I8, U8, I16, U16, I32, U32, I64, U64, F32, F64 };

struct ImageLocation {
  std::uint32_t byte = 0;
  std::uint8_t bit = 0;  // Bit only
  ImageType type = ImageType::Bool;
};

// 64-bit integers beyond 2^53 lose their last digits: the value is for showing, not for computing.
std::optional<double> read(const ImageLocation& location, std::span<const std::byte> image);

// A direct address in the input or output area: "%IX0.2", "%IW1" (bytes 2 and 3), "%QB4". An integer of width
// W is signed, as INT is. `output_offset` is where the output area begins; inputs begin at 0. nullopt for
// anything else, markers included.
std::optional<ImageLocation> location_of_address(std::string_view address, std::uint32_t output_offset);

}  // namespace stepwright::server

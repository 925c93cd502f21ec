#include "hmi_web/server/image_value.h"

#include <bit>
#include <charconv>

namespace stepwright::server {
namespace {

std::optional<std::uint64_t> little_endian(std::span<const std::byte> image, std::uint32_t at,
                                           std::uint32_t size) {
  if (at >= image.size() || image.size() - at < size) return std::nullopt;
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < size; ++i) {
    bits |= static_cast<std::uint64_t>(image[at + i]) << (8 * i);
  }
  return bits;
}

std::uint32_t size_of(ImageType type) {
  switch (type) {
    case ImageType::Bit:
    case ImageType::Bool:
    case ImageType::I8:
    case ImageType::U8: return 1;
    case ImageType::I16:
    case ImageType::U16: return 2;
    case ImageType::I32:
    case ImageType::U32:
    case ImageType::F32: return 4;
    case ImageType::I64:
    case ImageType::U64:
    case ImageType::F64: return 8;
  }
  return 1;
}

double to_double(std::uint64_t bits, const ImageLocation& location) {
  switch (location.type) {
    case ImageType::Bit: return static_cast<double>((bits >> location.bit) & 1);
    case ImageType::Bool: return bits != 0 ? 1 : 0;
    case ImageType::I8: return static_cast<std::int8_t>(bits);
    case ImageType::I16: return static_cast<std::int16_t>(bits);
    case ImageType::I32: return static_cast<std::int32_t>(bits);
    case ImageType::I64: return static_cast<double>(static_cast<std::int64_t>(bits));
    case ImageType::F32: return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    case ImageType::F64: return std::bit_cast<double>(bits);
    case ImageType::U8:
    case ImageType::U16:
    case ImageType::U32:
    case ImageType::U64: return static_cast<double>(bits);
  }
  return 0;
}

// Takes a decimal number off the front of `text`.
std::optional<std::uint32_t> take_number(std::string_view& text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || value > 0xFFFFFF) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

}  // namespace

std::optional<double> read(const ImageLocation& location, std::span<const std::byte> image) {
  const auto bits = little_endian(image, location.byte, size_of(location.type));
  if (!bits) return std::nullopt;
  return to_double(*bits, location);
}

std::optional<ImageLocation> location_of_address(std::string_view address, std::uint32_t output_offset) {
  if (address.size() < 4 || address[0] != '%') return std::nullopt;
  if (address[1] != 'I' && address[1] != 'Q') return std::nullopt;
  const std::uint32_t base = address[1] == 'Q' ? output_offset : 0;
  const char width = address[2];
  address.remove_prefix(3);
  const auto index = take_number(address);
  if (!index) return std::nullopt;
  if (width == 'X') {
    if (address.empty() || address[0] != '.') return std::nullopt;
    address.remove_prefix(1);
    const auto bit = take_number(address);
    if (!bit || *bit > 7 || !address.empty()) return std::nullopt;
    return ImageLocation{base + *index, static_cast<std::uint8_t>(*bit), ImageType::Bit};
  }
  if (!address.empty()) return std::nullopt;
  switch (width) {
    case 'B': return ImageLocation{base + *index, 0, ImageType::U8};
    case 'W': return ImageLocation{base + *index * 2, 0, ImageType::I16};
    case 'D': return ImageLocation{base + *index * 4, 0, ImageType::I32};
    case 'L': return ImageLocation{base + *index * 8, 0, ImageType::I64};
    default: return std::nullopt;
  }
}

}  // namespace stepwright::server

#include "hmi_web/server/image_value.h"

#include <charconv>

#include "runtime/bytecode/value_type.h"

namespace stepwright::server {
namespace {

using bytecode::ElementaryType;

// Takes a decimal number off the front of `text`.
std::optional<std::uint32_t> take_number(std::string_view& text) {
  constexpr std::uint32_t kMost = 0xFFFFFF;  // eight times as much still fits
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || value > kMost) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

std::optional<reader::Variable> bit_at(std::uint32_t byte, std::string_view rest) {
  if (rest.empty() || rest[0] != '.') return std::nullopt;
  rest.remove_prefix(1);
  const auto bit = take_number(rest);
  if (!bit || *bit > 7 || !rest.empty()) return std::nullopt;
  return reader::Variable{ElementaryType::Bool, byte, static_cast<std::uint8_t>(*bit)};
}

}  // namespace

std::optional<double> read(const reader::Variable& variable, std::span<const std::byte> image) {
  const std::uint32_t size = bytecode::size_of(bytecode::mem_type(variable.type));
  if (variable.address >= image.size() || image.size() - variable.address < size) return std::nullopt;
  return reader::read_number(variable, image);
}

std::optional<reader::Variable> variable_at(std::string_view address, std::uint32_t output_offset) {
  if (address.size() < 4 || address[0] != '%') return std::nullopt;
  if (address[1] != 'I' && address[1] != 'Q') return std::nullopt;
  const std::uint32_t base = address[1] == 'Q' ? output_offset : 0;
  const char width = address[2];
  address.remove_prefix(3);
  const auto index = take_number(address);
  if (!index) return std::nullopt;
  if (width == 'X') return bit_at(base + *index, address);
  if (!address.empty()) return std::nullopt;
  switch (width) {
    case 'B':
      return reader::Variable{ElementaryType::Usint, base + *index, bytecode::kNoBit};
    case 'W':
      return reader::Variable{ElementaryType::Int, base + *index * 2, bytecode::kNoBit};
    case 'D':
      return reader::Variable{ElementaryType::Dint, base + *index * 4, bytecode::kNoBit};
    default:
      return std::nullopt;
  }
}

}  // namespace stepwright::server

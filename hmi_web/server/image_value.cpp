#include "hmi_web/server/image_value.h"

#include "runtime/bytecode/value_type.h"
#include "runtime/naming/direct_address.h"

namespace stepwright::server {

using bytecode::ElementaryType;

std::optional<double> read(const reader::Variable& variable, std::span<const std::byte> image) {
  const std::uint32_t size = bytecode::size_of(bytecode::mem_type(variable.type));
  if (variable.address >= image.size() || image.size() - variable.address < size) return std::nullopt;
  return reader::read_number(variable, image);
}

std::optional<reader::Variable> variable_at(std::string_view address, std::uint32_t output_offset) {
  const auto place = naming::parse_direct_address(address);
  if (!place || place->area == naming::Area::Marker) return std::nullopt;
  const std::uint32_t byte = place->byte + (place->area == naming::Area::Output ? output_offset : 0);
  switch (place->bits) {
    case 1:
      return reader::Variable{ElementaryType::Bool, byte, place->bit};
    case 8:
      return reader::Variable{ElementaryType::Usint, byte, bytecode::kNoBit};
    case 16:
      return reader::Variable{ElementaryType::Int, byte, bytecode::kNoBit};
    case 32:
      return reader::Variable{ElementaryType::Dint, byte, bytecode::kNoBit};
    default:
      return std::nullopt;
  }
}

}  // namespace stepwright::server

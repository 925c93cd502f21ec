#include "hmi_web/server/image_value.h"

#include "runtime/bytecode/reader/read_value.h"
#include "runtime/bytecode/value_type.h"
#include "runtime/ground/naming/direct_address.h"

namespace stepwright::server {

using bytecode::ElementaryType;

namespace {

// Of a string: its header.
std::uint32_t bytes_of(const reader::Variable& variable) {
  return bytecode::is_string(variable.type) ? bytecode::kStringHeaderBytes
                                            : bytecode::size_of(bytecode::mem_type(variable.type));
}

bool lies_in(const reader::Variable& variable, std::span<const std::byte> image) {
  return variable.address < image.size() && image.size() - variable.address >= bytes_of(variable);
}

// At the end of a character.
void cut(std::string& text) {
  if (text.size() <= kMostTextBytes) return;
  std::size_t end = kMostTextBytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  text.resize(end);
  text += "\xE2\x80\xA6";  // an ellipsis
}

// A page computes with doubles, which have every integer up to here.
bool needs_digits(const reader::Variable& variable, std::span<const std::byte> image) {
  constexpr std::int64_t kLastExact = std::int64_t{1} << 53;
  if (!lies_in(variable, image)) return false;
  switch (variable.type) {
    case ElementaryType::Lint: {
      const auto value = std::get<std::int64_t>(reader::read_value(variable, image));
      return value > kLastExact || value < -kLastExact;
    }
    case ElementaryType::Ulint:
    case ElementaryType::Lword:
      return std::get<std::uint64_t>(reader::read_value(variable, image)) > std::uint64_t{kLastExact};
    default:
      return false;
  }
}

}  // namespace

bool overlap(const reader::Variable& one, const reader::Variable& other) {
  if (one.address >= other.address + bytes_of(other) || other.address >= one.address + bytes_of(one)) {
    return false;
  }
  return one.bit == bytecode::kNoBit || other.bit == bytecode::kNoBit || one.bit == other.bit;
}

bool overlap_any(const std::vector<reader::Variable>& places, const reader::Variable& variable) {
  return std::ranges::any_of(places, [&](const reader::Variable& place) { return overlap(place, variable); });
}

std::optional<double> read(const reader::Variable& variable, std::span<const std::byte> image) {
  if (bytecode::is_string(variable.type) || !lies_in(variable, image)) return std::nullopt;
  return reader::read_quantity(variable, image);
}

bool has_text(const reader::Variable& variable) {
  return bytecode::is_string(variable.type) || variable.type == ElementaryType::Date ||
         variable.type == ElementaryType::Tod || variable.type == ElementaryType::Dt;
}

std::optional<std::string> read_text(const reader::Variable& variable, std::span<const std::byte> image) {
  if (!lies_in(variable, image)) return std::nullopt;
  if (!has_text(variable) && !needs_digits(variable, image)) return std::nullopt;
  std::string text = reader::read_text(variable, image);
  cut(text);
  return text;
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

#include "runtime/bytecode/reader/read_value.h"

#include <charconv>
#include <cstring>

namespace stepwright::reader {

namespace {

template <typename T>
T read_as(std::span<const std::byte> image, std::uint32_t address) {
  T value;
  std::memcpy(&value, image.data() + address, sizeof(T));
  return value;
}

double shortest(float value) {
  char text[32];
  const auto written = std::to_chars(text, text + sizeof(text), value);
  double wide = value;
  std::from_chars(text, written.ptr, wide);
  return wide;
}

}  // namespace

Value read_value(const Variable& variable, std::span<const std::byte> image) {
  using bytecode::ElementaryType;
  const std::uint32_t at = variable.address;
  switch (variable.type) {
    case ElementaryType::Bool: {
      const auto byte = read_as<std::uint8_t>(image, at);
      return variable.bit == bytecode::kNoBit ? byte != 0 : ((byte >> variable.bit) & 1) != 0;
    }
    case ElementaryType::Sint:
      return std::int64_t{read_as<std::int8_t>(image, at)};
    case ElementaryType::Int:
      return std::int64_t{read_as<std::int16_t>(image, at)};
    case ElementaryType::Dint:
      return std::int64_t{read_as<std::int32_t>(image, at)};
    case ElementaryType::Lint:
    case ElementaryType::Time:
      return read_as<std::int64_t>(image, at);
    case ElementaryType::Usint:
    case ElementaryType::Byte:
      return std::uint64_t{read_as<std::uint8_t>(image, at)};
    case ElementaryType::Uint:
    case ElementaryType::Word:
      return std::uint64_t{read_as<std::uint16_t>(image, at)};
    case ElementaryType::Udint:
    case ElementaryType::Dword:
      return std::uint64_t{read_as<std::uint32_t>(image, at)};
    case ElementaryType::Ulint:
    case ElementaryType::Lword:
      return read_as<std::uint64_t>(image, at);
    case ElementaryType::Real:
      return shortest(read_as<float>(image, at));
    case ElementaryType::Lreal:
      return read_as<double>(image, at);
  }
  return false;
}

}  // namespace stepwright::reader

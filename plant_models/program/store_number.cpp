#include "plant_models/program/store_number.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace stepwright::program_plant {
namespace {

template <typename T>
void put(std::span<std::byte> image, std::uint32_t address, T value) {
  std::memcpy(image.data() + address, &value, sizeof(T));
}

template <typename T>
T whole(double number) {
  if (std::isnan(number)) return 0;
  const double rounded = std::round(number);
  if (rounded <= static_cast<double>(std::numeric_limits<T>::min())) return std::numeric_limits<T>::min();
  if (rounded >= static_cast<double>(std::numeric_limits<T>::max())) return std::numeric_limits<T>::max();
  return static_cast<T>(rounded);
}

// 32- and 64-bit slots carry signed and unsigned integers alike; the elementary type decides.
template <typename Signed>
void put_whole(std::span<std::byte> image, const reader::Variable& variable, double number) {
  using Unsigned = std::make_unsigned_t<Signed>;
  if (bytecode::is_unsigned(variable.type)) {
    put(image, variable.address, whole<Unsigned>(number));
  } else {
    put(image, variable.address, whole<Signed>(number));
  }
}

void put_bool(std::span<std::byte> image, const reader::Variable& variable, bool value) {
  std::byte& byte = image[variable.address];
  if (variable.bit == bytecode::kNoBit) {
    byte = std::byte{value};
    return;
  }
  const std::byte mask = std::byte{1} << variable.bit;
  byte = value ? byte | mask : byte & ~mask;
}

}  // namespace

void store_number(const reader::Variable& variable, double number, std::span<std::byte> image) {
  using bytecode::MemType;
  if (bytecode::is_string(variable.type)) return;
  const MemType memory = bytecode::mem_type(variable.type);
  if (std::size_t{variable.address} + bytecode::size_of(memory) > image.size()) return;
  switch (memory) {
    case MemType::Bool:
      return put_bool(image, variable, number != 0.0);
    case MemType::I8:
      return put(image, variable.address, whole<std::int8_t>(number));
    case MemType::U8:
      return put(image, variable.address, whole<std::uint8_t>(number));
    case MemType::I16:
      return put(image, variable.address, whole<std::int16_t>(number));
    case MemType::U16:
      return put(image, variable.address, whole<std::uint16_t>(number));
    case MemType::I32:
      return put_whole<std::int32_t>(image, variable, number);
    case MemType::I64:
      return put_whole<std::int64_t>(image, variable, number);
    case MemType::F32:
      return put(image, variable.address, static_cast<float>(number));
    case MemType::F64:
      return put(image, variable.address, number);
    case MemType::Ref:
      return;
  }
}

}  // namespace stepwright::program_plant

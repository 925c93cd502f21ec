#include <cstring>
#include <type_traits>

#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::reader {
namespace {

template <typename T>
double as_double(std::span<const std::byte> image, std::uint32_t address) {
  T value{};
  std::memcpy(&value, image.data() + address, sizeof(T));
  return static_cast<double>(value);
}

// 32- and 64-bit slots carry signed and unsigned integers alike; the elementary type decides.
template <typename Signed>
double integer(std::span<const std::byte> image, const Variable& variable) {
  using Unsigned = std::make_unsigned_t<Signed>;
  return bytecode::is_unsigned(variable.type) ? as_double<Unsigned>(image, variable.address)
                                              : as_double<Signed>(image, variable.address);
}

}  // namespace

double read_number(const Variable& variable, std::span<const std::byte> image) {
  using bytecode::MemType;
  if (bytecode::is_string(variable.type)) return 0.0;
  const MemType memory = bytecode::mem_type(variable.type);
  if (std::size_t{variable.address} + bytecode::size_of(memory) > image.size()) return 0.0;
  switch (memory) {
    case MemType::Bool: {
      const auto byte = std::to_integer<unsigned>(image[variable.address]);
      return variable.bit == bytecode::kNoBit ? (byte != 0 ? 1.0 : 0.0) : (byte >> variable.bit & 1u);
    }
    case MemType::I8:
      return as_double<std::int8_t>(image, variable.address);
    case MemType::U8:
      return as_double<std::uint8_t>(image, variable.address);
    case MemType::I16:
      return as_double<std::int16_t>(image, variable.address);
    case MemType::U16:
      return as_double<std::uint16_t>(image, variable.address);
    case MemType::I32:
      return integer<std::int32_t>(image, variable);
    case MemType::I64:
      return integer<std::int64_t>(image, variable);
    case MemType::F32:
      return as_double<float>(image, variable.address);
    case MemType::F64:
      return as_double<double>(image, variable.address);
    case MemType::Ref:
      return as_double<std::uint32_t>(image, variable.address);
  }
  return 0.0;
}

}  // namespace stepwright::reader

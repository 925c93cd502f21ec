#include "runtime/record/stored_values.h"

#include <cstdint>
#include <cstring>

namespace stepwright::record {
namespace {

using bytecode::ElementaryType;
using bytecode::TypeKind;

// Little-endian; of 8 bytes at most.
std::int64_t integer_of(std::span<const std::byte> bytes, bool has_sign) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes.data(), bytes.size());
  const auto shift = static_cast<int>(64 - 8 * bytes.size());
  return has_sign ? static_cast<std::int64_t>(bits << shift) >> shift : static_cast<std::int64_t>(bits);
}

template <typename Integer>
std::string outside(Integer value, Integer lower, Integer upper) {
  if (value >= lower && value <= upper) return {};
  return std::to_string(value) + " is outside of " + std::to_string(lower) + ".." + std::to_string(upper);
}

std::string wrong_number(const StateType& type, std::span<const std::byte> bytes) {
  if (!bytecode::is_unsigned(type.elementary))
    return outside(integer_of(bytes, true), type.lower, type.upper);
  return outside(static_cast<std::uint64_t>(integer_of(bytes, false)), static_cast<std::uint64_t>(type.lower),
                 static_cast<std::uint64_t>(type.upper));
}

std::string wrong_string(const StateType& type, std::span<const std::byte> bytes) {
  std::uint16_t capacity = 0;
  std::uint16_t length = 0;
  std::memcpy(&capacity, bytes.data(), sizeof capacity);
  std::memcpy(&length, bytes.data() + sizeof capacity, sizeof length);
  if (capacity == type.capacity && length <= capacity) return {};
  return std::to_string(length) + " of " + std::to_string(capacity) + " characters, in a string of " +
         std::to_string(type.capacity);
}

std::string wrong(const StateType& type, std::span<const std::byte> bytes) {
  if (type.kind == TypeKind::Subrange) return wrong_number(type, bytes);
  if (type.kind == TypeKind::String) return wrong_string(type, bytes);
  const bool is_bool = type.kind == TypeKind::Elementary && type.elementary == ElementaryType::Bool;
  if (is_bool && std::to_integer<unsigned>(bytes[0]) > 1) return "it is neither TRUE nor FALSE";
  return {};
}

std::string element_of(const StateVariable& variable, std::uint32_t index) {
  if (!variable.is_array) return variable.path;
  return variable.path + "[" + std::to_string(std::int64_t{variable.lower} + index) + "]";
}

}  // namespace

std::string wrong_value(const StateLayout& layout, std::span<const std::byte> block) {
  for (const StateVariable& variable : layout.variables()) {
    if (variable.bit != bytecode::kNoBit) continue;  // any bit is a value
    const StateType& type = layout.type_of(variable);
    for (std::uint32_t i = 0; i < variable.count; ++i) {
      const auto at = variable.address + std::size_t{i} * type.size;
      if (auto what = wrong(type, block.subspan(at, type.size)); !what.empty())
        return element_of(variable, i) + ": " + what;
    }
  }
  return {};
}

}  // namespace stepwright::record

#include "runtime/host/bool_bytes.h"

namespace stepwright::host {

BoolBytes::BoolBytes(const reader::ProgramInfo& info, std::uint32_t image_size) : is_bool_(image_size, 0) {
  for (const reader::Tag& tag : info.tags()) {
    const reader::Variable& variable = tag.variable;
    const bool byte = variable.type == bytecode::ElementaryType::Bool && variable.bit == bytecode::kNoBit;
    if (byte && variable.address < image_size) is_bool_[variable.address] = 1;
  }
}

std::uint64_t BoolBytes::settled(std::uint64_t address, std::uint32_t size, std::uint64_t value) const {
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::uint64_t byte = std::uint64_t{0xFF} << (i * 8);
    if (!holds(address + i) || (value & byte) == 0) continue;
    value = (value & ~byte) | std::uint64_t{1} << (i * 8);
  }
  return value;
}

void BoolBytes::settle(std::uint64_t address, std::span<std::byte> bytes) const {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (holds(address + i) && bytes[i] != std::byte{0}) bytes[i] = std::byte{1};
  }
}

}  // namespace stepwright::host

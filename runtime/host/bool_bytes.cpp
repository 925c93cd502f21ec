#include "runtime/host/bool_bytes.h"

#include <algorithm>
#include <utility>

#include "runtime/bytecode/reader/value_runs.h"

namespace stepwright::host {

result::Result<BoolBytes> BoolBytes::of(const bytecode::Program& program, const std::string& name) {
  std::vector<std::uint8_t> is_bool(program.image_size(), 0);
  auto visited = reader::visit_values(program, name, [&](const reader::ValueRun& run) {
    if (run.is_bool_byte()) std::fill_n(is_bool.begin() + run.address, run.count, std::uint8_t{1});
  });
  if (!visited) return result::forward(visited);
  return BoolBytes(std::move(is_bool));
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

#include "tests/unit/runtime/modbus/oracle/tables.h"

#include <algorithm>
#include <cstdio>

namespace stepwright::modbus::oracle {

namespace {

std::uint8_t bit_at(std::size_t index, std::uint32_t table) {
  const std::uint32_t mixed = (static_cast<std::uint32_t>(index) + table) * 2654435761u;
  return static_cast<std::uint8_t>((mixed >> 13) & 1);
}

std::uint16_t register_at(std::size_t index, std::uint32_t table) {
  return static_cast<std::uint16_t>(static_cast<std::uint32_t>(index) * 40503u + table * 12345u + 0x55AAu);
}

template <typename Value>
void append_changes(char letter, const char* format, std::span<const Value> before,
                    std::span<const Value> now, std::string& out) {
  if (std::ranges::equal(before, now)) return;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (before[i] == now[i]) continue;
    char text[32];
    std::snprintf(text, sizeof text, format, letter, i, static_cast<unsigned>(now[i]));
    if (!out.empty()) out += ' ';
    out += text;
  }
}

}  // namespace

Tables::Tables(Sizes sizes) {
  for (std::size_t i = 0; i < sizes.bits; ++i) {
    coils.push_back(bit_at(i, 0));
    discrete_inputs.push_back(bit_at(i, 1));
  }
  for (std::size_t i = 0; i < sizes.registers; ++i) {
    holding_registers.push_back(register_at(i, 2));
    input_registers.push_back(register_at(i, 3));
  }
}

std::string changes(const TablesView& before, const TablesView& now) {
  std::string out;
  append_changes('c', "%c%zu=%u", before.coils, now.coils, out);
  append_changes('d', "%c%zu=%u", before.discrete_inputs, now.discrete_inputs, out);
  append_changes('h', "%c%zu=%04x", before.holding_registers, now.holding_registers, out);
  append_changes('i', "%c%zu=%04x", before.input_registers, now.input_registers, out);
  return out;
}

}  // namespace stepwright::modbus::oracle

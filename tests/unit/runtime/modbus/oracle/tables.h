#pragma once

// The four tables that every peer of the oracle serves, with the same values, and what a request changed in
// them.
//
// Values come from formulas that pymodbus_peer.py repeats, so that no peer copies another's.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace stepwright::modbus::oracle {

// How many bits the two tables of bits have each, how many registers the two others.
struct Sizes {
  std::size_t bits = 0;
  std::size_t registers = 0;
};

struct TablesView {
  std::span<const std::uint8_t> coils;  // 0 or 1 each
  std::span<const std::uint8_t> discrete_inputs;
  std::span<const std::uint16_t> holding_registers;
  std::span<const std::uint16_t> input_registers;
};

struct Tables {
  explicit Tables(Sizes sizes);
  TablesView view() const { return {coils, discrete_inputs, holding_registers, input_registers}; }

  std::vector<std::uint8_t> coils;
  std::vector<std::uint8_t> discrete_inputs;
  std::vector<std::uint16_t> holding_registers;
  std::vector<std::uint16_t> input_registers;
};

// The differences, in order: "c12=1 h3=a0ff"; the letters are c, d, h and i.
std::string changes(const TablesView& before, const TablesView& now);

}  // namespace stepwright::modbus::oracle

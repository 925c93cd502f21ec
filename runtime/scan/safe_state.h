#pragma once

// What the outputs do when nobody may drive them: stopped, trapped, or I/O lost.

#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::scan {

enum class SafeMode : std::uint8_t {
  Zero,   // off
  Hold,   // as they are
  Value,  // a fixed value
};

// The rule for some bits of one output byte. Bits without a rule go to zero; of several rules for a bit the
// last one holds.
struct SafeOutput {
  std::uint32_t byte = 0;    // of the output area; rules for bytes outside it have no effect
  std::uint8_t mask = 0xFF;  // the bits it is about
  SafeMode mode = SafeMode::Zero;
  std::uint8_t value = 0;  // SafeMode::Value
};

// Puts the output area into its safe state.
void apply_safe_state(std::span<const SafeOutput> rules, std::span<std::byte> outputs);

}  // namespace stepwright::scan

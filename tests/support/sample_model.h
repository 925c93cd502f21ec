#pragma once

// A container that uses every section: two tasks, a function, a function block with a timer, located bits, an
// array, a chart. The verifier's and the scan's tests share it.

#include "runtime/bytecode/writer/container_model.h"

namespace stepwright::support {

// Addresses of the sample's variables.
struct SampleLayout {
  static constexpr std::uint32_t kInputs = 0;   // 4 bytes: %IX0.0 start, %IW1 raw
  static constexpr std::uint32_t kOutputs = 4;  // 2 bytes: %QX0.0 pump, %QX0.1 slow_bit
  static constexpr std::uint32_t kMain = 6;     // instance of MAIN
  static constexpr std::uint32_t kMainSize = 56;
  static constexpr std::uint32_t kTimer = 0;                 // in MAIN: the block, 18 bytes
  static constexpr std::uint32_t kLevel = 18;                // in MAIN: REAL
  static constexpr std::uint32_t kHistory = 22;              // in MAIN: ARRAY[1..8] OF INT
  static constexpr std::uint32_t kCount = 38;                // in MAIN: DINT
  static constexpr std::uint32_t kStep = 42;                 // in MAIN: step bit
  static constexpr std::uint32_t kSlow = kMain + kMainSize;  // instance of SLOW: DINT
  static constexpr std::uint32_t kSlowSize = 4;
};

// Every 10 ms: pump := TON(start, 30 ms); level := SCALE(raw); history[1 + count MOD 8] := raw; count + 1.
// Every 20 ms, with lower priority: SLOW counts and toggles %QX0.1.
writer::ContainerModel sample_model();

}  // namespace stepwright::support

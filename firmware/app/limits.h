#pragma once

// Fixed numbers of the firmware, and what a program may need that a controller lacks.

#include <cstdint>

#include "runtime/modbus/control/registers.h"

namespace stepwright::app {

inline constexpr std::uint8_t kUnit = 1;                        // address on the line
inline constexpr std::int64_t kSilenceNs = 500'000'000;         // of the master: its I/O is lost
inline constexpr std::int64_t kFrameSilenceNs = 50'000'000;     // what has begun on the line is no frame
inline constexpr std::int64_t kRetainPeriodNs = 1'000'000'000;  // changed values are written at most so often
inline constexpr std::uint32_t kWatchdogMs = 4000;              // longer than any budget allows a scan to be
inline constexpr std::uint64_t kBudget = 2'000'000;             // of a scan, in bytes of code
inline constexpr std::uint32_t kMaxInputBytes = modbus::control::inputs::kMaxBytes;
inline constexpr std::uint32_t kMaxOutputBytes = modbus::control::outputs::kMaxBytes;

// The detail of control::Refusal::NotSupported. The numbers are part of the protocol.
enum class Lacking : std::uint32_t {
  Nothing = 0,
  Memory = 1,       // for image, frames, stack, event image and retained values
  InputBytes = 2,   // the program has more than the inputs block carries
  OutputBytes = 3,  // ... than the outputs block carries
  RetainBytes = 4,  // ... than a retain area holds
  Scratch = 5,  // memory for the verifier beside the program that is loaded: its longest function is too long
  Operations = 6,  // the basic firmware has no strings and no elementary functions
};

}  // namespace stepwright::app

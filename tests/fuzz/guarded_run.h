#pragma once

// Runs any bytes as a container: parse, verify and, if it is accepted, interpret. The memory that the
// verifier and the engine may write lies between guard bands, so that a write beside it shows without a
// sanitizer. The same bytes always do the same.
//
//   ASSERT_NE(fuzz::guarded_run(bytes), fuzz::Outcome::BrokeOut);

#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::fuzz {

enum class Outcome : std::uint8_t {
  Refused,   // by the verifier
  TooLarge,  // accepted; needs more memory than a test gives
  Ran,       // every program call, some to a trap
  BrokeOut,  // a guard band was written to, a trap is located nowhere, or a budget was overdrawn
};

// `bytes` may be changed: the header's length and checksum are put right first, so that a mutation gets
// behind them.
void repair_header(std::span<std::byte> bytes);

// Three scans of every program call of every task, at three different times.
Outcome guarded_run(std::span<const std::byte> bytes);

}  // namespace stepwright::fuzz

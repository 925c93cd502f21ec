#pragma once

// Runs any bytes as a container: parse, verify and, if it is accepted, run it on every engine of this
// machine. The memory that the verifier and the engines may use lies against pages without access
// (guarded.h), in front of it or behind it as `side` says, so that a read or write beside it stops the
// process. The engines must agree on the memory, the traps and the budget. The same bytes always do the same.
//
//   ASSERT_NE(fuzz::guarded_run(bytes, fuzz::Side::Back), fuzz::Outcome::BrokeOut);

#include <cstddef>
#include <cstdint>
#include <span>

#include "tests/fuzz/guarded.h"

namespace stepwright::fuzz {

enum class Outcome : std::uint8_t {
  Refused,   // by the verifier
  TooLarge,  // accepted; needs more memory than a test gives
  Ran,       // every program call, some to a trap
  BrokeOut,  // a pattern was written over, a trap is located nowhere, or a budget was overdrawn
  Differs,   // the engines do not agree
};
inline constexpr std::size_t kOutcomes = 5;

// `bytes` may be changed: the header's length and checksum are put right first, so that a mutation gets
// behind them.
void repair_header(std::span<std::byte> bytes);

// Three scans of every program call of every task, at three different times.
Outcome guarded_run(std::span<const std::byte> bytes, Side side);

}  // namespace stepwright::fuzz

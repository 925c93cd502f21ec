#pragma once

// Which errors of a standard function can be told before it runs (IEC 61131-3, 6.6.1.5); see error_guard.cpp.

#include <cstddef>
#include <cstdint>

#include "ladder/semantics/model/value.h"

namespace stepwright::semantics::internal {

enum class ErrorTest : std::uint8_t {
  None,
  Divisor,         // a division by zero
  Places,          // a negative number of places of a shift
  Choice,          // MUX: K names no input
  Range,           // a real that the integer type does not hold
  Single,          // an LREAL that is beyond REAL
  Duration,        // a real that is no time or date
  Domain,          // SQRT, LN, LOG, ASIN, ACOS
  Power,           // 0 to a negative power, a negative number to one that is no integer
  Code,            // digits that are none, or of a number that the type does not hold
  Digits,          // a number with more digits than the BCD type has
  Counts,          // texts: a negative number of characters or position
  FirstCharacter,  // of a text without characters
  Literal,         // a text that is no literal of the type
  Arguments,       // of a function of the library, which another one tells of
};

ErrorTest error_test(const Value& called);

// Whether the test needs this operand, or what stands behind it does.
bool is_kept_aside(ErrorTest test, const Value& called, std::size_t operand);

}  // namespace stepwright::semantics::internal

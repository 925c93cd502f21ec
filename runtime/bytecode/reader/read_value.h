#pragma once

// The exact value of a variable, for reports and traces; read_number (program_info.h) is its cousin for
// plots.

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::reader {

// BOOL; signed integers and TIME (nanoseconds); unsigned integers and bit strings; REAL and LREAL.
using Value = std::variant<bool, std::int64_t, std::uint64_t, double>;

// Requires the image of the variable's program. A REAL gives the double with the same shortest decimal form,
// so that 0.1 reads 0.1.
Value read_value(const Variable& variable, std::span<const std::byte> image);

}  // namespace stepwright::reader

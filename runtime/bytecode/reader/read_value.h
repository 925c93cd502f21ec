#pragma once

// The exact value of a variable, for reports and traces; read_number (program_info.h) is its cousin for
// plots.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>

#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::reader {

// BOOL; signed integers, TIME and dates (nanoseconds); unsigned integers, bit strings and characters (code
// units); REAL and LREAL; STRING and WSTRING as UTF-8.
using Value = std::variant<bool, std::int64_t, std::uint64_t, double, std::string>;

// Requires the image of the variable's program. A REAL gives the double with the same shortest decimal form,
// so that 0.1 reads 0.1.
Value read_value(const Variable& variable, std::span<const std::byte> image);

// The value as a quantity: as read_number, but a TIME in seconds. What people, alarms, the history and pages
// compute with.
double read_quantity(const Variable& variable, std::span<const std::byte> image);

// The value as a person writes it: TRUE, 12, 0.1, T#1s500ms, D#2024-02-29, the name of an enumerator, the
// text of a string without quotes. Requires the image of the variable's program.
std::string read_text(const Variable& variable, std::span<const std::byte> image);

// The same for terminals: a string as its literal writes it between the quotes, "a$N$1B[31m".
std::string read_printable(const Variable& variable, std::span<const std::byte> image);

}  // namespace stepwright::reader

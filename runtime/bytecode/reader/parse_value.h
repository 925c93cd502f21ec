#pragma once

// A literal of IEC 61131-3 as the value of a variable: what read_text writes, parse_value reads.
//
//   parse_value(level, "16#FF")        // any integer or bit string, with its range
//   parse_value(delay, "T#1s500ms")
//   parse_value(mode, "Auto")          // an enumerator, also Mode#Auto
//
// Pure functions; any thread.

#include <cstdint>
#include <string_view>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/result.h"

namespace stepwright::reader {

// The bits of the value, in as many of its lowest bytes as the variable has; of a BOOL 0 or 1. Fails with
// `code` at `where`: no literal of the variable's type, out of range, or a string, which has more than one
// value's bits.
[[nodiscard]] result::Result<std::uint64_t> parse_value(const Variable& variable, std::string_view text,
                                                        const char* code = "R0058",
                                                        const result::Location& where = {});

}  // namespace stepwright::reader

#pragma once

// A text as the value of a STRING or WSTRING: what read_text writes, parse_string reads; in quotes it is a
// literal of IEC 61131-3, without them every character is itself.
//
//   parse_string(recipe, "Weißbier")
//   parse_string(recipe, "'two$Nlines'")     // "two$Nlines" of a WSTRING
//   parse_string(recipe, "''")               // empty
//
// Pure functions; any thread.

#include <cstddef>
#include <string_view>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/result.h"

namespace stepwright::reader {

// The bytes of the string in memory, from its length (kStringLengthAt) to the end of the new text; what lies
// behind it stays. Requires a string. Fails with `code` at `where`: longer than the variable, a wrong escape,
// or a character beyond 255 in a STRING.
[[nodiscard]] result::Result<std::vector<std::byte>> parse_string(const Variable& variable,
                                                                  std::string_view text,
                                                                  const char* code = "R0058",
                                                                  const result::Location& where = {});

// Where the length lies, from the address of the variable on; its capacity is before it.
inline constexpr std::uint32_t kStringLengthAt = 2;

}  // namespace stepwright::reader

#pragma once

// Diagnostic about bad input: a code, a place, a message and a hint. Plain values; any thread.

#include <cstdint>
#include <string>
#include <vector>

namespace stepwright::result {

enum class Severity : std::uint8_t { Note, Warning, Error };

// A place in an input. `file` may be empty (standard input, a received sample); line and column count
// from 1, 0 = unknown. For files without lines (TOML keys, JSON) `key` names the place instead.
struct Location {
  std::string file;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

struct Diagnostic {
  std::string code;  // stable, e.g. "P0012" (PDDL), "E0103" (IEC languages), "C0004" (configuration)
  Severity severity = Severity::Error;
  Location where;
  std::string message;  // one sentence without its place
  std::string hint;     // what to do about it; may be empty
};

using Diagnostics = std::vector<Diagnostic>;

// "file:line:col: code: message" and, on a second line, "  hint: ..."; missing parts are left out.
std::string to_string(const Diagnostic& diagnostic);
std::string to_string(const Diagnostics& diagnostics);

// True if any of them is an Error.
bool has_errors(const Diagnostics& diagnostics);

}  // namespace stepwright::result

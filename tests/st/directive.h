#pragma once

// The comments of a language test that say what must come out.
//
//   (* SET scan 2: main.go = TRUE *)             before the scan
//   (* CHECK scan 3: main.x = 5 *)               after the scan
//   (* CHECK x = 5 *)                            short for: scan 1, variable of `main`
//   (* CHECK trap scan 4: division by zero *)    the scan ends with this trap, in the line of the comment;
//                                                or "at 7", "at 7:12"
//   (* ERROR E0301 *)                            refused, with this error in the line of the comment;
//                                                or "at 7:12"
//   (* WARNING W0001 *)                          as ERROR, yet the program runs
//   (* REQ REQ-61131-7.3.3.1-01 *)               the requirements that the program shows (tests/conformance)
//
// Values: TRUE, 5, 16#FF, -0.5, INF, NAN, 'text', "wide", T#30ms, D#2024-02-29, TOD#.., DT#.., an enumerator.

#include <cstdint>
#include <string>
#include <vector>

namespace stepwright::st_test {

enum class DirectiveKind : std::uint8_t { Set, Check, Trap, Diagnostic, Requirement };

struct Directive {
  DirectiveKind kind = DirectiveKind::Check;
  std::uint64_t scan = 1;
  std::string subject = {};     // a variable; the name of a trap; a diagnostic's code; a requirement's id
  std::string value = {};       // Set, Check
  std::uint32_t line = 0;       // of the comment
  std::uint32_t at_line = 0;    // Trap, Diagnostic: where it is expected
  std::uint32_t at_column = 0;  // Trap, Diagnostic: 0 = any
};

// Throws std::runtime_error on a comment that begins like a directive and is none.
std::vector<Directive> directives_of(const std::string& text);

}  // namespace stepwright::st_test

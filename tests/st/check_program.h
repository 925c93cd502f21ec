#pragma once

// A language test: an ST program whose comments say what must come out when it runs.
//
//   (* SET scan 2: main.go = TRUE *)              before the scan
//   (* CHECK scan 3: main.x = 5 *)                after the scan; values: TRUE, 5, -0.5, T#30ms
//   (* CHECK trap scan 4: division by zero at 7 *)  the scan ends with this trap in line 7 of the file

#include <cstdint>
#include <string>
#include <vector>

namespace stepwright::st_test {

enum class DirectiveKind : std::uint8_t { Set, Check, Trap };

struct Directive {
  DirectiveKind kind = DirectiveKind::Check;
  std::uint64_t scan = 0;
  std::string variable;  // Trap: the name of the trap
  std::string value;     // Trap: the line
  std::uint32_t line = 0;
};

// Throws std::runtime_error on a comment that begins like a directive and is none.
std::vector<Directive> directives_of(const std::string& text);

// Compiles and runs the program; every check that fails as one line "file:line: ...". Empty = passed.
std::vector<std::string> run_checks(const std::string& name, const std::string& text);

}  // namespace stepwright::st_test

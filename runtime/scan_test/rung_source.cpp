#include "runtime/scan_test/rung_source.h"

#include <fmt/format.h>

#include <iterator>

namespace stepwright::scan_test {

std::string rung_source(std::uint32_t rungs, std::int64_t interval_us) {
  std::string text = fmt::format(
      "CONFIGURATION scan_test\n  TASK scan(INTERVAL := T#{}us, PRIORITY := 0);\n"
      "  PROGRAM main WITH scan : rungs;\nEND_CONFIGURATION\n"
      "PROGRAM rungs\nVAR count : UDINT; coil : ARRAY[0..{}] OF BOOL; END_VAR\ncount := count + 1;\n"
      "coil[0] := (count MOD 2) = 1;\n",
      interval_us, rungs + 2);
  for (std::uint32_t i = 1; i <= rungs; ++i) {
    fmt::format_to(std::back_inserter(text), "coil[{}] := (coil[{}] OR coil[{}]) AND NOT coil[{}];\n", i,
                   i - 1, i + 1, i + 2);
  }
  return text + "END_PROGRAM\n";
}

}  // namespace stepwright::scan_test

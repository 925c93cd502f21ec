#pragma once

// Programs that the tests of the firmware download.

#include <stdexcept>
#include <string>
#include <vector>

#include "ladder/driver/compile.h"

namespace stepwright::test {

inline std::vector<std::byte> compiled(const std::string& text) {
  driver::CompileInput input;
  input.texts.push_back({"test.st", text});
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  return std::move(output->container);
}

// Counts scans, keeps every tenth of them, copies a byte from the inputs to the outputs.
inline const char* const kCounting = R"(
PROGRAM main
VAR
  inputs AT %IB0 : USINT;
  outputs AT %QB0 : USINT;
  scans AT %QW1 : INT;
  marker AT %MW0 : INT;
  wide AT %MD1 : DINT;
  long AT %ML1 : LINT;
  flag : BOOL;
END_VAR
VAR RETAIN
  kept : DINT;
END_VAR
  outputs := inputs;
  scans := scans + 1;
  kept := kept + 1;
END_PROGRAM
)";

inline const char* const kDividing = R"(
PROGRAM main
VAR
  divisor AT %IB0 : USINT;
  lamp AT %QX0.0 : BOOL;
  result : INT;
END_VAR
  lamp := TRUE;
  result := 100 / divisor;
END_PROGRAM
)";

inline const char* const kEndless = R"(
PROGRAM main
VAR lamp AT %QX0.0 : BOOL; END_VAR
  lamp := TRUE;
  WHILE TRUE DO lamp := TRUE; END_WHILE;
END_PROGRAM
)";

}  // namespace stepwright::test

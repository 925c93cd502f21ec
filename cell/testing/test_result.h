#pragma once

// Result of a test. Plain values; any thread.

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::cell_testing {

// Why a test failed. The diagnostic holds the whole of it in words; of a trap it has a code.
struct Failure {
  result::Diagnostic diagnostic;
  // Of an assertion.
  std::string statement;    // "ASSERT_EQ"
  std::string actual_text;  // what it looked at, as it was written
  std::string actual;       // values as literals; empty if there is none
  std::string expected;
  std::string tolerance;
  std::string message;  // of the test's author
};

struct TestResult {
  std::string name;
  result::Location where;
  std::optional<Failure> failure;  // none: passed
  std::int64_t simulated_ns = 0;
  std::uint64_t scans = 0;
  double wall_us = 0;

  bool passed() const { return !failure; }
};

}  // namespace stepwright::cell_testing

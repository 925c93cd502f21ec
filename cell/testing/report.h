#pragma once

// The outcome of a run for people and for machines.

#include <cstddef>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "cell/testing/test_result.h"
#include "ladder/source/source_set.h"

namespace stepwright::cell_testing {

struct TestReport {
  std::string engine;
  std::vector<TestResult> tests;
  std::size_t left_out = 0;         // by the filter
  result::Diagnostics diagnostics;  // of the sources; errors: no test ran
  double wall_s = 0;                // compiling included

  std::size_t failed() const;
  double simulated_s() const;
};

// "ok    name   T#2s, 201 scans", and of a failure its place, its line and a caret below. `number` counts
// from 1; where there are many tests it stands in front.
void print_test(std::ostream& out, const TestResult& test, std::size_t number, std::size_t count,
                std::span<const source::NamedText> files);
void print_summary(std::ostream& out, const TestReport& report);

// One JSON object.
std::string to_json(const TestReport& report);

// JUnit XML: a testsuite for each source file. Wrong sources are a test case with an error.
std::string to_junit(const TestReport& report);

}  // namespace stepwright::cell_testing

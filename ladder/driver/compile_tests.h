#pragma once

// The TESTs of IEC 61131-3 sources as programs that a runner executes (ladder/doc/testing.md): the other way
// to compile sources beside compile.h, as pure as that.
//
//   auto output = driver::compile_tests(input);
//   for (const TestSuite& suite : output->suites) ...
//
// A suite is a container whose last task holds one program for each test. The task never becomes due; the
// runner calls its programs, all of which lie at one place of the image, and scans the other tasks while a
// test waits. semantics/test_case.h says how runner and test speak.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ladder/driver/compile.h"
#include "ladder/semantics/model/test_case.h"
#include "runtime/bytecode/value_type.h"
#include "runtime/ground/result/result.h"

namespace stepwright::driver {

using semantics::TestEventKind;
using semantics::TestHeader;

// A single value in the instance of a test.
struct TestOperand {
  bytecode::ElementaryType type = bytecode::ElementaryType::Bool;
  std::uint32_t offset = 0;
  std::map<std::int64_t, std::string> enumerators;  // empty if it is no enumeration
};

struct TestEvent {
  TestEventKind kind = TestEventKind::Assertion;
  result::Location where;
  std::string statement;    // "ASSERT_EQ"
  std::string actual_text;  // Assertion: what it looks at, as it was written
  std::string relation;     // "=", "TRUE", "+-": how that should be
  std::optional<TestOperand> actual;
  std::optional<TestOperand> expected;
  std::optional<TestOperand> tolerance;
  bool has_message = false;
};

struct TestCase {
  std::string name;
  result::Location where;
  std::vector<std::byte> initial;  // what the instance starts with
  std::vector<TestEvent> events;   // number n is at n - 1
};

struct TestSuite {
  std::vector<std::byte> container;
  std::vector<TestCase> tests;  // in the order of the calls of the last task
};

struct TestOutput {
  std::vector<TestSuite> suites;  // one, and one more for each file that has mocks
  result::Diagnostics warnings;
};

// Fails with every diagnostic found. Programs run as compile() says; without a CONFIGURATION and with none or
// several PROGRAMs, nothing runs but the tests. No suite if there is no TEST.
[[nodiscard]] result::Result<TestOutput> compile_tests(const CompileInput& input);

}  // namespace stepwright::driver

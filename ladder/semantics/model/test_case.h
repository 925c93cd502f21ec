#pragma once

// A TEST after analysis (ladder/doc/testing.md): a program whose instance begins with a header, through which
// it and the runner speak, and behind its own variables holds what its assertions compared.
//
// The runner calls the program with `event` 0. When it returns, 0 says that the test has passed; another
// number names the event (from 1) that it returned for. After a wait the runner does what was asked for, sets
// `event` to 0 and calls again: the program goes on behind the wait, which `resume` remembers. An assertion
// that failed is an event too, and the last one.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ladder/semantics/types/type.h"
#include "ladder/source/source_set.h"

namespace stepwright::semantics {

// Offsets in the instance of a test.
struct TestHeader {
  static constexpr std::uint32_t kResume = 0;    // UDINT, the runner leaves it alone
  static constexpr std::uint32_t kEvent = 4;     // UDINT
  static constexpr std::uint32_t kArgument = 8;  // LINT: nanoseconds or scans of a wait
  static constexpr std::uint32_t kMessage = 16;  // STRING[kMessageCapacity]: of an assertion that failed
  static constexpr std::uint32_t kMessageCapacity = 254;
};

enum class TestEventKind : std::uint8_t { AdvanceTime, RunScans, Assertion };

// A value that an assertion kept.
struct TestOperand {
  const Type* type = nullptr;
  std::uint32_t offset = 0;  // in the instance
};

struct TestEvent {
  TestEventKind kind = TestEventKind::Assertion;
  std::string statement;  // "ASSERT_EQ"
  source::Position where;
  // Assertion: what it looks at as it was written, and how that should be: "= 3", "TRUE".
  std::string_view actual_text;
  std::string_view relation;
  std::optional<TestOperand> actual;  // none: its value is the contrary of the relation
  std::optional<TestOperand> expected;
  std::optional<TestOperand> tolerance;  // ASSERT_NEAR
  bool has_message = false;
};

struct Pou;

struct Test {
  std::string name;
  source::Position where;
  Pou* pou = nullptr;
  std::vector<TestEvent> events;
};

}  // namespace stepwright::semantics

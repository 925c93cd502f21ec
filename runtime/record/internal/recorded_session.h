#pragma once

// The session that a recording begins with, and where a cycle stands at a State, as a file gives them: any
// bytes are safe to read, and values that no runtime writes are refused here, so that whoever computes with
// them (ramps, due times) never meets one that overflows or divides by zero.
//
// Pure; any thread.

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "runtime/base/byte_reader.h"
#include "runtime/bytecode/program.h"
#include "runtime/scan/safe_state.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::record {

// The latest instant of a scan clock that a recording may name: 73 years. The sum of two, and of one and any
// interval, is a number.
inline constexpr std::int64_t kLatestNs = std::numeric_limits<std::int64_t>::max() / 4;

constexpr bool is_instant(std::int64_t time_ns) {
  return time_ns >= 0 && time_ns <= kLatestNs;
}

// The rules of the safe state refer to this object: it outlives the cycles that are configured with it.
class RecordedSession {
 public:
  // The fields behind the record's kind. Null if it is a session, else what is wrong with it.
  const char* read(base::ByteReader in);

  std::uint64_t budget() const { return budget_; }
  scan::SafeMatrix matrix() const;

 private:
  struct SafeColumn {
    std::vector<scan::SafeOutput> outputs;
    std::vector<scan::SafeRamp> ramps;
  };
  static bool read_column(base::ByteReader& in, SafeColumn& column);

  std::uint64_t budget_ = 0;
  std::array<SafeColumn, scan::kSafeCauses> columns_;
};

// The point of a State, from its scan cycle's state on up to the forces. False if it is cut short or can be
// that of no program.
bool read_point(base::ByteReader& in, scan::CyclePoint& point);

// Whether a cycle of the program whose own tasks stand in `own` (CyclePoint::tasks) can stand at this point:
// the same tasks, due when such tasks can be.
bool fits(const scan::CyclePoint& point, const scan::CyclePoint& own, const bytecode::Program& program);

}  // namespace stepwright::record

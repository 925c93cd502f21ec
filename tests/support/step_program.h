#pragma once

// A program with a chart whose steps follow each other after a fixed number of scans: every test that watches
// a runtime knows in advance which scan brings which event.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stepwright::support {

struct StepProgramOptions {
  std::uint32_t steps = 3;  // step k is active in scans k x scans_per_step + 1 to (k + 1) x scans_per_step
  std::uint32_t scans_per_step = 10;  // the last step stays
  bool trap_at_end = false;           // a user trap in the scan in which the last step would end
  std::uint32_t interval_us = 10'000;
  std::uint32_t input_bytes = 8;
};

struct StepProgramLayout {
  static constexpr std::uint32_t kOutput = 8;  // %QX0.0 while step 0 is active, %QX0.1 otherwise
  static constexpr std::uint32_t kCount = 9;   // DINT: scans so far
  static constexpr std::uint32_t kFree = 13;   // LINT that the program never touches
  static constexpr std::uint32_t kSteps = 21;  // BOOL per step
};

// The layout holds for 8 input bytes.
std::vector<std::byte> step_program(const StepProgramOptions& options = {});

}  // namespace stepwright::support

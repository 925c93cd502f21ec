#pragma once

// Difference between two programs, one of which would take over from the other: variables, steps, addresses,
// tasks, and what the runtime would refuse. Sources are compared by the page (hmi_web/doc/change.md).
//
//   auto diff = compare(running, next, image);
//   diff->retyped.front();                          // {"MAIN.count", "INT", "DINT"}
//
// Pure; any thread. Fails with R0021 (record::StateLayout).

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/ground/result/result.h"

namespace stepwright::change {

// A variable, an address or a task on both sides; empty where it is missing.
struct Difference {
  std::string name;
  std::string before;
  std::string after;
};

struct StepDifference {
  std::string name;
  bool active = false;  // of a step that goes: now
};

struct ProgramDiff {
  std::uint32_t carried = 0;  // variables that keep their values
  std::vector<Difference> added;
  std::vector<Difference> removed;
  std::vector<Difference> retyped;     // have their initial values
  std::vector<Difference> shortened;   // keep what fits
  std::vector<Difference> references;  // have their initial values
  std::vector<Difference> moved;       // addresses
  std::vector<Difference> tasks;
  std::vector<StepDifference> steps_added;
  std::vector<StepDifference> steps_removed;
  // Problems for which the runtime would refuse the change now, with charts that go on and with charts that
  // restart.
  result::Diagnostics keep;
  result::Diagnostics restart_charts;
};

// `image` of the running program; empty: active steps are not known. What the compiler has made for itself is
// left out.
[[nodiscard]] result::Result<ProgramDiff> compare(const reader::LoadedProgram& running,
                                                  const reader::LoadedProgram& next,
                                                  std::span<const std::byte> image);

}  // namespace stepwright::change

#pragma once

// Scan timing beside a bare wake-up loop: the same process, the same seconds, the same interval and priority,
// half an interval apart, so that neither waits for the other.
//
//   auto measured = measure(container, {.seconds = 10.0}, [](double done) { ... });
//
// Threads: one; brings those of the runtime, of the loop and of the load.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/host/engine_choice.h"
#include "runtime/scan/task_timing.h"
#include "runtime/scan_test/load_generator.h"

namespace stepwright::scan_test {

struct MeasureOptions {
  double seconds = 10.0;
  LoadKinds load;
  int cpu = -1;  // both loops run on this processor only; -1: any
  host::EngineKind engine = host::EngineKind::Auto;
};

struct Measurement {
  std::string task;  // whose timing it is: the most urgent cyclic one
  std::uint32_t interval_us = 0;
  scan::TaskTiming scan;
  scan::TaskTiming bare;
  std::uint64_t overruns = 0;  // of all tasks
  std::string note;            // what the system refused, or why the program ended early
};

// `progress` gets the part that is done, 0 to 1, several times a second. Fails as the runtime does, with
// R0074 for the load, and with R0075 if the program is not cyclic or ended within the time.
[[nodiscard]] result::Result<Measurement> measure(const std::vector<std::byte>& container,
                                                  const MeasureOptions& options,
                                                  const std::function<void(double)>& progress);

}  // namespace stepwright::scan_test

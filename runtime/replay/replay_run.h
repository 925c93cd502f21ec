#pragma once

// A recording replayed on one engine, with variables written as a table on the way. Threads: any one.

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/host/engine_choice.h"
#include "runtime/record/replay.h"
#include "runtime/trace/names.h"

namespace stepwright::replay {

struct RunOptions {
  std::string file;
  host::EngineKind engine = host::EngineKind::Vm;
  std::uint64_t until = 0;              // the last scan to run; 0: all
  std::vector<trace::AskedName> trace;  // variables for the table
  std::string csv_file;                 // empty: no table
};

struct RunResult {
  record::ReplayReport report;
  double wall_s = 0.0;
  std::uint64_t rows = 0;  // of the table
};

// Fails if the file is no recording, a name is none, or the table cannot be written. Damage and differences
// stand in the report.
[[nodiscard]] result::Result<RunResult> run(const RunOptions& options);

}  // namespace stepwright::replay

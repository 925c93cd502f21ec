#pragma once

// Runs a recording again, without plant and without clock: every scan on the inputs that it had, every
// command where it came; each recorded hash is compared with the hash of the image that comes out.
//
//   ReplayOptions options;
//   options.engine = [](const bytecode::Program& p) { return host::make_engine(host::EngineKind::Vm, p); };
//   auto report = replay("run.swrec", options);
//   report->difference                            // none: every image was the same
//
// Threads: any one. Damage does not fail a replay: what stands before it is replayed, and the report's
// problems say where it lies.

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/bytecode/engine.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/trap.h"
#include "runtime/ground/result/result.h"
#include "runtime/image/process_image.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::record {

using EngineFactory =
    std::function<result::Result<std::unique_ptr<bytecode::Engine>>(const bytecode::Program&)>;

struct ReplayOptions {
  EngineFactory engine;
  std::uint64_t until = std::numeric_limits<std::uint64_t>::max();  // the last scan to run
  // Called when a program takes over, before its first scan, and after every scan. What on_program refuses
  // ends the replay.
  std::function<result::Result<void>(const reader::LoadedProgram&)> on_program;
  std::function<void(const scan::ScanReport&, const image::ProcessImage&)> on_scan;
};

// A variable that came out differently, as a person writes its values.
struct VariableDifference {
  std::string name;
  std::string recorded;
  std::string replayed;
};

struct Difference {
  std::uint64_t scan = 0;  // the first that differs
  std::string what;        // "image", "time" or "state"
  std::string recorded;    // hash, time or state
  std::string replayed;
  // By the next keyframe; empty if none follows.
  std::uint64_t keyframe_scan = 0;
  std::vector<VariableDifference> variables;
};

struct ReplayReport {
  std::uint64_t first_scan = 0;
  std::uint64_t last_scan = 0;
  std::uint64_t scans = 0;   // that ran
  std::uint64_t hashes = 0;  // compared
  std::uint64_t keyframes = 0;
  std::uint64_t programs = 0;
  std::uint64_t starts = 0;
  std::uint64_t stops = 0;
  std::uint64_t commands = 0;  // forces, unforces, writes
  std::int64_t simulated_ns = 0;
  std::uint64_t trace_hash = 0;     // of the cycle after the last scan
  std::vector<std::uint64_t> gaps;  // first missing scan of each
  std::optional<Difference> difference;
  bool ended = false;                      // the recording says that it ends here, or `until` was reached
  std::optional<result::Diagnostic> trap;  // the newest
  result::Diagnostics problems;            // damage, missing scans
};

// Fails if the file is no recording that can be begun with (R0051, R0054, R0059), or with what the engine
// factory or on_program says.
[[nodiscard]] result::Result<ReplayReport> replay(const std::string& path, const ReplayOptions& options);

}  // namespace stepwright::record

#pragma once

// Runs a program without a clock and without I/O: for tests and for trying a program out.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/bytecode/trap.h"
#include "runtime/ground/result/result.h"
#include "runtime/host/engine_choice.h"
#include "runtime/trace/csv_trace.h"

namespace stepwright::exec {

struct ExecOptions {
  host::EngineKind engine = host::EngineKind::Vm;
  std::uint64_t scans = 1;
  std::vector<std::string> trace;  // names of variables
  trace::CsvTrace* csv = nullptr;  // gets a row with them after every scan; the caller finishes it
};

struct TrapReport {
  std::uint64_t scan = 0;
  bytecode::Trap trap;
  result::Diagnostic diagnostic;
};

struct ExecReport {
  std::uint64_t scans = 0;  // that ran, the one with the trap included
  std::vector<std::pair<std::string, std::vector<reader::Value>>> trace;  // one value per scan
  std::vector<TrapReport> traps;
  std::uint64_t image_hash = 0;  // after the last scan
  std::uint64_t trace_hash = 0;
};

// Inputs stay zero; ends with the first trap. Fails if a traced variable does not exist.
[[nodiscard]] result::Result<ExecReport> run(const reader::LoadedProgram& loaded, const ExecOptions& options);

}  // namespace stepwright::exec

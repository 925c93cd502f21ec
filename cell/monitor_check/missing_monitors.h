#pragma once

// Check that a program that was compiled elsewhere has the monitors of its cell: for whoever brings one to
// the runtime, and for a runtime that starts with one. It knows no compiler.
//
// Pure; any thread.
//
//   for (const auto& problem : missing_monitors(config, container)) ...

#include <cstddef>
#include <span>

#include "cell/config/cell_config.h"
#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::cell_monitors {

// C0558 for each monitor that the program lacks, at its place in the configuration.
result::Diagnostics missing_monitors(const config::CellConfig& config, const reader::ProgramInfo& program);
// Of bytes that are not verified yet; none for a cell without monitors, and for what is no program: that is
// for the verifier to say.
result::Diagnostics missing_monitors(const config::CellConfig& config, std::span<const std::byte> container);

}  // namespace stepwright::cell_monitors

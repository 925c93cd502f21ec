#pragma once

// The program of a cell from its [runtime] sources, in memory: what `stepwright up` would run.
//
// Reads files; any thread.

#include <optional>

#include "programs/check/check_program.h"

namespace stepwright::check {

// Adds what the compiler says of the sources; nothing if they do not compile.
std::optional<CellProgram> compile_sources(const config::CellConfig& config, result::Diagnostics& problems);

}  // namespace stepwright::check

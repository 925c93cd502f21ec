#pragma once

// State of a cell's program, as the runtime tells it over the cell's socket. Threads: any.

#include <string>

#include "cell/config/cell_config.h"
#include "cell/processes/cell_record.h"

namespace stepwright::up {

// The state of a program of which nothing is known.
inline constexpr const char* kNoAnswer = "unknown";

// `clock`: "real" or "simulated", for the words of its mode. Waits two seconds for an answer; the state is
// kNoAnswer then, and the detail says why.
processes::ProgramRecord ask_program(const config::CellConfig& config, const std::string& clock = {});

bool is_in_fault(const processes::ProgramRecord& program);

// Whether the program that the cell names is not loaded, or nothing is known of it.
bool is_missing(const processes::ProgramRecord& program, const config::CellConfig& config);

}  // namespace stepwright::up

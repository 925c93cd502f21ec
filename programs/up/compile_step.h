#pragma once

// The commands that make the program of a cell from its sources, and bring it in.
//
// Pure, but for keep_program() and compile().

#include <filesystem>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "programs/up/memory_file.h"
#include "runtime/ground/process/child_process.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::up {

// `stepwright compile` of [runtime] sources, with the monitors of the cell, into `image`, so that what it
// says is of the sources alone and never of a disk.
process::ChildOptions compile_command(const config::CellConfig& config, const std::filesystem::path& programs,
                                      const MemoryFile& image);
// `stepwright download --change`.
process::ChildOptions change_command(const config::CellConfig& config,
                                     const std::vector<std::string>& overrides,
                                     const std::filesystem::path& programs,
                                     const std::filesystem::path& image);

// Where a program waits beside the cell's program until it runs and takes its place.
std::filesystem::path fresh_image(const config::CellConfig& config);
// Writes what the compiler has made. E0002 or nothing.
result::Diagnostics keep_program(const std::filesystem::path& file, const std::string& bytes);

// Compiles the cell's program, if it has sources; what is wrong with them goes to standard error. Waits.
// Nothing is written where the program of before is the same. Fails with M0001, M0014, and with E0002 if the
// program compiles and cannot be kept.
[[nodiscard]] result::Result<result::ExitCode> compile(const config::CellConfig& config,
                                                       const std::filesystem::path& programs,
                                                       const process::StopSignal& stop);

}  // namespace stepwright::up

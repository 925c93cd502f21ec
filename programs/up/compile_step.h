#pragma once

// The commands that make the program of a cell from its sources, and bring it in.
//
// Pure, but for compile().

#include <filesystem>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/ground/process/child_process.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::up {

// `stepwright compile` of [runtime] sources, with the monitors of the cell.
process::ChildOptions compile_command(const config::CellConfig& config, const std::filesystem::path& programs,
                                      const std::filesystem::path& image);
// `stepwright download --change`.
process::ChildOptions change_command(const config::CellConfig& config,
                                     const std::vector<std::string>& overrides,
                                     const std::filesystem::path& programs,
                                     const std::filesystem::path& image);

// Where a program is compiled to, beside the cell's program, before it takes its place.
std::filesystem::path fresh_image(const config::CellConfig& config);

// Compiles the cell's program, if it has sources; what is wrong with them goes to standard error. Waits.
// Fails with M0001.
[[nodiscard]] result::Result<result::ExitCode> compile(const config::CellConfig& config,
                                                       const std::filesystem::path& programs,
                                                       const process::StopSignal& stop);

}  // namespace stepwright::up

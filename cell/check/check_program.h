#pragma once

// A cell against the program that it runs: whether the runtime (or the controller) has room for it, whether
// the register map of [modbus.server] and the tags of [[modbus.device]] are about variables that it has.
//
// Pure but for the files of find_program.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"

namespace stepwright::check {

struct CellProgram {
  std::string name;  // for diagnostics: a path, or what made it
  std::vector<std::byte> container;
};

// `image` if it is not empty, else what a start of the cell would load; nothing if there is neither. Fails as
// the load does: R0024, R0026.
[[nodiscard]] result::Result<std::optional<CellProgram>> find_program(const config::CellConfig& config,
                                                                      const std::filesystem::path& image);

// Everything that does not fit, at its place in the configuration: what a load refuses (B0001 to B0006,
// R0080, R0010, R0145), C0501 to C0505 of the register map, C0528 and C0529 of the tags (check_tags.h),
// C0531 of the plant's wires (check_wires.h), C0532 of alarms, recipes and drawings (check_names.h).
result::Diagnostics check_program(const config::CellConfig& config, const CellProgram& program);

// Puts what was found behind the problems.
void add(result::Diagnostics& problems, const result::Diagnostics& found);

}  // namespace stepwright::check

#pragma once

// Check whether a program has room in a cell: the areas of its I/O and its image. Asked when it is loaded,
// and by whoever wants to know before.
//
// Pure; any thread.

#include <cstddef>
#include <string>

#include "runtime/bytecode/program.h"
#include "runtime/result/result.h"

namespace stepwright::host {

// What a cell has, in bytes.
struct CellAreas {
  std::size_t input_bytes = 0;
  std::size_t output_bytes = 0;
};

// Fails with R0004 at the place `name` (a path, or "download").
[[nodiscard]] result::Result<void> check_fit(const bytecode::Program& program, const CellAreas& areas,
                                             const std::string& name);

}  // namespace stepwright::host

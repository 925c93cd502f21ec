#pragma once

// Checks whether a program fits a cell: the areas of its I/O and its image. Called when it is loaded, and by
// tools before that.
//
// Pure; any thread.

#include <cstddef>
#include <string>

#include "runtime/bytecode/program.h"
#include "runtime/ground/result/result.h"

namespace stepwright::host {

// Sizes of a cell's I/O areas.
struct CellAreas {
  std::size_t input_bytes = 0;
  std::size_t output_bytes = 0;
};

// Fails with R0080 at the place `name` (a path, or "download").
[[nodiscard]] result::Result<void> check_fit(const bytecode::Program& program, const CellAreas& areas,
                                             const std::string& name);

}  // namespace stepwright::host

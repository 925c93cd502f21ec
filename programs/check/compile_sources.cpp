#include "programs/check/compile_sources.h"

#include <utility>

#include "cell/program/compile_cell.h"

namespace stepwright::check {

std::optional<CellProgram> compile_sources(const config::CellConfig& config, result::Diagnostics& problems) {
  auto container = cell_program::compile_cell(config, problems);
  if (!container) return std::nullopt;
  return CellProgram{config.boot.sources.front().string(), std::move(*container)};
}

}  // namespace stepwright::check

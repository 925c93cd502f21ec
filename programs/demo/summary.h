#pragma once

// The figures of a demo run under the stable keys that scripts read (`demo --json`).

#include <optional>
#include <string>

#include "programs/demo/cell_run.h"

namespace stepwright::demo {

// `sequential` is the same cell with a strictly sequential chart, for comparison; may be missing.
std::string summary_json(const CellRunResult& run, const std::optional<CellRunResult>& sequential);
// The same for people, without the table of the actions.
std::string summary_text(const CellRunResult& run, const std::optional<CellRunResult>& sequential);

}  // namespace stepwright::demo

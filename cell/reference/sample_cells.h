#pragma once

// Cells that make the readers of a cell's file ask for every key they know: a row in each array of tables, a
// name (NAME, TAG, LINE, PORT) where the file chooses it, each kind of plant, every key that is asked for
// only where it stands. Files that they name are not there. For the reference and its test, never for a
// process.
//
// Pure; any thread.

#include <span>
#include <string_view>

namespace stepwright::reference {

std::span<const std::string_view> sample_cells();

}  // namespace stepwright::reference

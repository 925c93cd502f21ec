#pragma once

// The cells that come with Stepwright, each a folder with a cell.toml: of an installation
// (PREFIX/share/stepwright/cells, its programs in PREFIX/libexec/stepwright), or of the tree that was built.
//
//   auto file = find_cell("bench");   // ".../cells/bench/cell.toml"
//
// Threads: any.

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::processes {

// Their names, in the order of the alphabet.
std::vector<std::string> known_cells();

// A path to a configuration as it is, or the file of a known cell. M0002: there is none of this name.
[[nodiscard]] result::Result<std::filesystem::path> find_cell(const std::string& cell);

}  // namespace stepwright::processes

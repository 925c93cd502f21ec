#pragma once

// Check of the text files of a cell that nobody else holds against UTF-8: sources and formulas. Their
// comments and texts stand on the page. Tables, drawings and TOML are refused by whoever reads them.
//
// Any thread; reads files.

#include "cell/config/cell_config.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::check {

// C0533 (a warning: the program runs all the same) at the first byte that is none. A file that cannot be read
// is told elsewhere.
result::Diagnostics check_texts(const config::CellConfig& config);

}  // namespace stepwright::check

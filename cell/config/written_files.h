#pragma once

// Files that a cell writes and its configuration names: [retain] file, [record] file, [log] file, and
// [runtime] program where `stepwright up` makes it from sources. None of them may be a file that the cell
// reads, nor two of them one file, and a program replaces a program only. Otherwise a slip in a path costs
// somebody a file.
//
// Threads: any. Reads the first bytes of [runtime] program.

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::config {

struct CellConfig;

// C0472 at the key that names a file which would be lost; nothing if none would.
result::Diagnostics check_written_files(const CellConfig& config);

}  // namespace stepwright::config

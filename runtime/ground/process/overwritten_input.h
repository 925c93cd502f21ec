#pragma once

// Finds an output that would overwrite what a command reads, before the command begins: `--json main.st`
// beside `main.st`, or a report in place of a file that is none.
//
// Threads: any.

#include "runtime/ground/result/diagnostic.h"

namespace CLI {
class App;
}

namespace stepwright::process {

// Of the arguments that `app` has parsed. Outputs are the options --json, --out, --output, --svg and --csv;
// all others count as inputs as far as they name a file. What --json names is replaced only where it is
// empty, an object or a list. E0004 for each file that would be lost.
result::Diagnostics overwritten_inputs(const CLI::App& app);

}  // namespace stepwright::process

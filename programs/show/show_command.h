#pragma once

// The command `show`: programs as a control engineer prints them.

namespace stepwright::show {

// `argv[1]` is "show". Prints diagnostics to stderr, each with its source line and a caret; returns the exit
// code of the process. A file that is written appears complete or not at all.
int run_show(int argc, char** argv);

}  // namespace stepwright::show

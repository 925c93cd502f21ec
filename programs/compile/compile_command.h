#pragma once

// The command `compile`: ST sources to an image file.

namespace stepwright::compile_program {

// `argv[1]` is "compile". Prints diagnostics to stderr, each with its source line and a caret; returns the
// exit code of the process. The image appears complete or not at all.
int run_compile(int argc, char** argv);

}  // namespace stepwright::compile_program

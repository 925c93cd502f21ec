#pragma once

// The command `compile`: ST sources and PLCopen projects to an image file.

#include <string>
#include <vector>

#include "ladder/source_files/source_options.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::compile_program {

struct CompileArguments {
  std::vector<std::string> sources;
  std::string image;
  bool check = false;  // instead of writing an image
  std::string cell;    // whose monitors are compiled with it; empty: none
  std::string json_file;
  bool bare = false;  // without the sources for viewers
  sources::SourceOptions options;
  std::vector<std::string> warnings;  // "none", "default", "all"; "error": warnings are errors
};

// Prints diagnostics to stderr, each with its source line and a caret. The image appears complete or not at
// all.
result::ExitCode run_compile(const CompileArguments& arguments);

}  // namespace stepwright::compile_program

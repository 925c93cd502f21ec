#include "programs/process/command_line.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

namespace stepwright::process {

std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  const std::string name = app.get_name();
  const std::string command = name.substr(name.rfind(' ') + 1);
  const int skip = argc > 1 && argv[1] == command ? 1 : 0;
  try {
    app.parse(argc - skip, argv + skip);
  } catch (const CLI::ParseError& error) {
    return to_int(app.exit(error) == 0 ? result::ExitCode::Done : result::ExitCode::Usage);
  }
  return std::nullopt;
}

int fail(const result::Diagnostics& diagnostics, result::ExitCode code) {
  std::fprintf(stderr, "%s\n", result::to_string(diagnostics).c_str());
  return to_int(code);
}

}  // namespace stepwright::process

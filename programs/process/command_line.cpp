#include "programs/process/command_line.h"

#include <signal.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace stepwright::process {
namespace {

// Longer than anybody waits, and safe to count in any unit.
constexpr double kLongestS = 1e9;

}  // namespace

// Who reads what a process says may go away at any time. To ignore the signal would be inherited by every
// program that a process starts; a handler is not.
void outlive_broken_pipes() {
  struct sigaction action {};
  action.sa_handler = [](int) {};
  action.sa_flags = SA_RESTART;
  sigaction(SIGPIPE, &action, nullptr);
}

std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  outlive_broken_pipes();
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

std::string refuse_seconds(const std::string& text) {
  char* end = nullptr;
  const double seconds = std::strtod(text.c_str(), &end);
  if (end != text.c_str() && *end == '\0' && seconds > 0.0 && seconds <= kLongestS) return {};
  return "'" + text + "' is not a number of seconds above 0";
}

int fail(const result::Diagnostics& diagnostics, result::ExitCode code) {
  std::fprintf(stderr, "%s\n", result::to_string(diagnostics).c_str());
  return to_int(code);
}

}  // namespace stepwright::process

#include "runtime/ground/process/command_line.h"

#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <system_error>

namespace stepwright::process {
namespace {

// Longer than anybody waits, and safe to count in any unit.
constexpr double kLongestS = 1e9;

// There may be no memory to put a text together.
void say(const char* text) {
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, std::strlen(text));
}

[[noreturn]] void end(const char* refused, const char* hint) {
  say("R0001: the system gives no more ");
  say(refused);
  say("\n  hint: ");
  say(hint);
  say("\n");
  std::_Exit(to_int(result::ExitCode::RuntimeFault));
}

[[noreturn]] void on_terminate() {
  try {
    if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    end("memory", "the limit of its unit (MemoryMax) or of the shell (ulimit -v) may be reached");
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again)
      end("threads", "the limit of its unit (TasksMax) or of its user (ulimit -u) may be reached");
  } catch (...) {
  }
  std::abort();
}

// An option takes one value each time that it is named: "--set KEY=VALUE NAME" leaves NAME to the arguments,
// in whatever order they stand.
void take_one_value_each(CLI::App& app) {
  for (CLI::Option* each : app.get_options())
    if (!each->get_positional() && each->get_expected_max() > 1) each->allow_extra_args(false);
  for (CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; })) take_one_value_each(*each);
}

}  // namespace

// Who reads what a process says may go away at any time. To ignore the signal would be inherited by every
// program that a process starts; a handler is not.
void outlive_broken_pipes() {
  struct sigaction action {};
  action.sa_handler = [](int) {};
  action.sa_flags = SA_RESTART;
  sigaction(SIGPIPE, &action, nullptr);
}

void end_with_a_word() {
  std::set_terminate(on_terminate);
}

std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  outlive_broken_pipes();
  end_with_a_word();
  const std::string name = app.get_name();
  const std::string command = name.substr(name.rfind(' ') + 1);
  take_one_value_each(app);
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

std::string refuse_seed(const std::string& text) {
  const bool number =
      !text.empty() && text.size() <= 18 && text.find_first_not_of("0123456789") == std::string::npos;
  return number ? "" : "'" + text + "' is no whole number of up to 18 digits";
}

int fail(const result::Diagnostics& diagnostics, result::ExitCode code) {
  std::fprintf(stderr, "%s\n", result::to_string(diagnostics).c_str());
  return to_int(code);
}

}  // namespace stepwright::process

#include "runtime/ground/process/command_line.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "runtime/ground/process/overwritten_input.h"
#include "runtime/ground/process/standard_output.h"

namespace stepwright::process {
namespace {

// Longer than anybody waits, and safe to count in any unit.
constexpr double kLongestS = 1e9;

// There may be no memory to put a text together.
void say(const char* text) {
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, std::strlen(text));
}

[[noreturn]] void end(const char* refused, const char* hint) {
  say("R0077: the system gives no more ");
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

// Where a JSON document goes that is to be on standard output, alone: a copy of it, while words for people go
// to standard error from now on. "-" if there is no such copy.
std::string output_for_a_document() {
  std::fflush(stdout);
  const int copy = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (copy < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return "-";
  return "/dev/fd/" + std::to_string(copy);
}

// The arguments, where "--json -" names a place at which nothing but the document arrives. Two outputs that
// are both "-" are the command's to refuse.
std::vector<std::string> with_output_of_its_own(std::vector<std::string> arguments) {
  constexpr std::string_view kJoined = "--json=-";
  const auto is_output = [&](const std::string& each) { return each == "-" || each.ends_with("=-"); };
  if (std::ranges::count_if(arguments, is_output) != 1) return arguments;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == kJoined) arguments[i] = "--json=" + output_for_a_document();
    if (i > 0 && arguments[i - 1] == "--json" && arguments[i] == "-") arguments[i] = output_for_a_document();
  }
  return arguments;
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
  tell_lost_output();
  const std::string name = app.get_name();
  const std::string command = name.substr(name.rfind(' ') + 1);
  take_one_value_each(app);
  const int skip = argc > 1 && argv[1] == command ? 1 : 0;
  std::vector<std::string> arguments =
      with_output_of_its_own({argv + skip + 1, argv + std::max(argc, skip + 1)});
  std::ranges::reverse(arguments);  // as the library takes them
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    return to_int(app.exit(error) == 0 ? result::ExitCode::Done : result::ExitCode::Usage);
  }
  if (const auto problems = overwritten_inputs(app); !problems.empty())
    return fail(problems, result::ExitCode::Usage);
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

// The process behind `stepwright reach`.

#include <CLI/CLI.hpp>

#include <string>

#include "programs/reach/reach_command.h"
#include "runtime/ground/process/command_line.h"

namespace {

using namespace stepwright;

std::string is_file_name(const std::string& text) {
  return text.empty() ? "a file has a name" : "";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Says what a sequence of picks and places leaves to positions and angles, or why it cannot be done",
      "stepwright reach");
  reach_program::ReachArguments arguments;
  app.add_option("sequence", arguments.sequence,
                 "the cell and its actions, TOML (supervisor/doc/intervals.md)")
      ->required();
  app.add_option("--json", arguments.json_file, "write ranges or cause as JSON")->check(is_file_name);
  app.add_option("--svg", arguments.svg_file, "draw the cell from above, with what is reached")
      ->check(is_file_name);
  app.add_option("--st", arguments.st_file,
                 "write a function block for each arm that checks a pose against its reach")
      ->check(is_file_name);
  app.footer(
      "Exit codes: 0 the constraints have a solution, 1 wrong input, 2 wrong usage, 3 refuted (the cause is "
      "said), 4 neither within the budget.");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  return result::to_int(reach_program::run_reach(arguments));
}

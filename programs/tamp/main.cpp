// The process behind `stepwright tamp`.

#include <CLI/CLI.hpp>

#include <string>

#include "programs/tamp/tamp_command.h"
#include "runtime/ground/process/command_line.h"

int main(int argc, char** argv) {
  using namespace stepwright;
  CLI::App app("Plans tasks and motions of a robot cell together, without a plant", "stepwright tamp");
  tamp_program::TampArguments arguments;
  app.add_option("problem", arguments.problem, "the cell and its problem, TOML (supervisor/doc/tamp.md)")
      ->required();
  const auto is_file_name = [](const std::string& text) {
    return std::string(text.empty() ? "a file has a name" : "");
  };
  app.add_option("--json", arguments.json_file, "write the plan with its motions, and figures")
      ->check(is_file_name);
  app.add_option("--svg", arguments.svg_file, "draw the cell from above, before and after")
      ->check(is_file_name);
  app.add_option("--seed", arguments.seed, "of the planner of paths (default 1)")
      ->check(CLI::Validator(process::refuse_seed, "NUMBER"));
  app.add_option("--time", arguments.time_s, "time budget in seconds (default 60)")
      ->check(CLI::Validator(process::refuse_seconds, "SECONDS"));
  app.add_option("--method", arguments.method,
                 "ours (default), paper-literal, paper-first-way or paper-from-one")
      ->check(CLI::IsMember({"ours", "paper-literal", "paper-first-way", "paper-from-one"}));
  app.add_option("--grasps", arguments.grasps, "samples of the hand's angle, in place of the file's")
      ->check(CLI::Range(1, 1024));
  app.add_option("--places", arguments.places, "samples of a place, in place of the file's")
      ->check(CLI::Range(1, 100'000));
  app.footer(
      "Exit codes: 0 a plan was found and judged, 1 wrong input, 2 wrong usage, 3 no plan exists (proved), 4 "
      "the "
      "budget ended, or Ctrl-C or SIGTERM came, before there was a plan, 5 the judge refuses the plan.");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  return result::to_int(tamp_program::run_tamp(arguments));
}

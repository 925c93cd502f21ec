// The process behind `stepwright htn`.

#include <CLI/CLI.hpp>

#include "programs/htn/htn_command.h"
#include "runtime/ground/process/command_line.h"

int main(int argc, char** argv) {
  using namespace stepwright;
  CLI::App app("Plans by decomposing tasks: totally ordered hierarchies in HDDL", "stepwright htn");
  htn_program::HtnArguments arguments;
  app.add_option("domain", arguments.domain, "the HDDL domain (supervisor/doc/htn.md)")->required();
  app.add_option("problem", arguments.problem, "the HDDL problem")->required();
  app.add_option("--time", arguments.time_s, "time budget in seconds (default 10)")
      ->check(CLI::Validator(process::refuse_seconds, "SECONDS"));
  app.add_option(
         "--external", arguments.external,
         "a predicate that is judged elsewhere: its conditions are taken to hold, its effects are left "
         "out (may be given again)")
      ->allow_extra_args(false);
  app.add_option("--json", arguments.json_file, "write the outcome, the decomposition and figures as JSON");
  app.add_option("--out", arguments.out_file,
                 "write the plan with its decomposition in the form of the IPC 2020");
  app.footer(
      "Exit codes: 0 a plan was found and judged, 1 wrong input, 2 wrong usage, 3 no plan exists (proved), 4 "
      "the budget ended, or Ctrl-C or SIGTERM came, before there was a plan.");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  return result::to_int(htn_program::run_htn(arguments));
}

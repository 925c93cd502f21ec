// `stepwright up|down|status [CELL.toml]`: all processes of a cell, kept alive, until somebody ends them.

#include <CLI/CLI.hpp>

#include "programs/up/down_command.h"
#include "programs/up/status_command.h"
#include "programs/up/up_command.h"
#include "runtime/ground/process/command_line.h"

namespace {

using stepwright::up::Options;

CLI::App* add(CLI::App& app, Options& options, const char* name, const char* what) {
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("CELL", options.cell, "the cell's file (default: cell.toml of this folder)");
  command->add_option("--set", options.overrides, "KEY=VALUE that wins over the file, e.g. hmi.port=8081")
      ->allow_extra_args(false);
  return command;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Keep the processes of a cell up, end them, say how they are", "stepwright");
  app.require_subcommand(1);
  Options options;
  CLI::App* const up = add(app, options, "up", "start all processes of a cell, and keep them alive");
  up->add_option("--port", options.port, "port of the web page")->check(CLI::Range(0, 65'535));
  up->add_flag("--watch", options.watch,
               "compile sources that are saved, and bring them in between two scans");
  up->add_flag("--detach", options.detach, "return when the cell is ready; `stepwright down` ends it");
  up->footer(
      "Exit codes: 0 the cell is down again, 1 something is wrong with it, 2 usage, 5 a process has failed.");
  CLI::App* const down = add(app, options, "down", "end all processes of a cell that is up, in order");
  down->footer(
      "Exit codes: 0 it is down, 1 the file is wrong, 2 usage, 5 a process had to be killed, or it does not "
      "end.");
  CLI::App* const status = add(app, options, "status", "say how the processes of a cell are");
  status->add_flag("--json", options.json, "as JSON");
  status->footer(
      "Exit codes: 0 it is up and all are ready, 1 the file is wrong, 2 usage, 5 it is not, or its program "
      "is in "
      "fault or does not answer.");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  if (down->parsed()) return stepwright::up::run_down(options);
  return status->parsed() ? stepwright::up::run_status(options) : stepwright::up::run_up(options);
}

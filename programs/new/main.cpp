// `stepwright new NAME [--plant none|tanks|conveyor|modbus] [--plan] [--from PROJECT.xml]`: the folder of a
// new cell, which runs as it is.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "ladder/source/dialect.h"
#include "programs/new/new_command.h"
#include "runtime/ground/process/command_line.h"

int main(int argc, char** argv) {
  using namespace stepwright;
  CLI::App app{"Write the folder of a new cell, which runs as it is", "stepwright new"};
  new_cell::NewOptions options;
  app.add_option("NAME", options.folder, "of the cell and of its folder")->required();
  auto* const plant =
      app.add_option("--plant", options.plant,
                     "none: a program of its own; tanks, conveyor: a simulated plant; modbus: devices")
          ->check(CLI::IsMember({"none", "tanks", "conveyor", "modbus"}));
  auto* const plan = app.add_flag("--plan", options.plan,
                                  "a batch cell that plans: a plant of components, domain, problem, binding")
                         ->excludes(plant);
  auto* const from =
      app.add_option("--from", options.from,
                     "take the programs, tasks and I/O of a PLCopen project (Beremiz, OpenPLC Editor, "
                     "CODESYS): its file, or the folder with its plc.xml")
          ->excludes(plant)
          ->excludes(plan);
  std::vector<std::string> dialects;
  for (const source::Dialect& each : source::dialects()) dialects.emplace_back(each.name);
  app.add_option("--dialect", options.dialect, "the system that the project comes from (default matiec)")
      ->check(CLI::IsMember(dialects))
      ->needs(from);
  app.add_option("--configuration", options.configuration, "of those that the project has")->needs(from);
  app.footer(
      "Exit codes: 0 the cell is there and runs, 1 it was not written, or does not run (its program does not "
      "compile), 2 "
      "usage.");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  const auto made = new_cell::make_cell(options);
  if (!made) return process::fail(made.error(), result::ExitCode::BadInput);
  if (!made->left.empty()) std::printf("not taken (README.md has the list, too):\n");
  for (const std::string& each : made->left) std::printf("  %s\n", each.c_str());
  if (!made->problems.empty()) {
    const bool in_cell = made->problems.front().where.file == "cell.toml";
    std::printf("%s is written, but it does not run: its %s.\n", options.folder.c_str(),
                in_cell ? "cell.toml is wrong" : "program does not compile");
    return process::fail(made->problems, result::ExitCode::BadInput);
  }
  std::printf("%s is a cell now. Its README.md says what is in it:\n  cd %s\n  stepwright up\n",
              options.folder.c_str(), options.folder.c_str());
  return to_int(result::ExitCode::Done);
}

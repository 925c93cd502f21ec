// `stepwright new NAME [--plant none|tanks|conveyor|modbus]`: the folder of a new cell, which runs as it is.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "programs/new/new_command.h"
#include "runtime/ground/process/command_line.h"

int main(int argc, char** argv) {
  using namespace stepwright;
  CLI::App app{"Write the folder of a new cell, which runs as it is", "stepwright new"};
  new_cell::NewOptions options;
  app.add_option("NAME", options.folder, "of the cell and of its folder")->required();
  app.add_option("--plant", options.plant,
                 "none: a program of its own; tanks, conveyor: a simulated plant; modbus: devices")
      ->check(CLI::IsMember({"none", "tanks", "conveyor", "modbus"}));
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  if (const auto made = new_cell::make_cell(options); !made)
    return process::fail(made.error(), result::ExitCode::BadInput);
  std::printf("%s is a cell now. Its README.md says what is in it:\n  cd %s\n  stepwright up\n",
              options.folder.c_str(), options.folder.c_str());
  return to_int(result::ExitCode::Done);
}

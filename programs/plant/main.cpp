// The process behind `stepwright plant`.

#include <CLI/CLI.hpp>

#include <string>

#include "programs/plant/plant_command.h"
#include "runtime/ground/process/command_line.h"

namespace {

using namespace stepwright;

std::string is_file_name(const std::string& text) {
  return text.empty() ? "a file has a name" : "";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Checks a plant of components, lists it, and runs it without a controller",
               "stepwright plant");
  plant_program::PlantArguments arguments;
  app.add_option("file", arguments.file, "the plant, TOML (plant_models/doc/components.md)");
  app.add_flag("--types", arguments.types,
               "list the types of components, with their parameters, ports and faults");
  app.add_option("--seconds", arguments.seconds, "of simulated time that it is run for (60)")
      ->check(process::refuse_seconds);
  app.add_option("--interval", arguments.interval_s, "seconds from row to row")
      ->check(process::refuse_seconds);
  app.add_option("--set", arguments.sets, "TERMINAL=VALUE or TERMINAL=VALUE@SECONDS; again for each");
  app.add_option("--fault", arguments.faults, "FAULT=VALUE or FAULT=VALUE@SECONDS; again for each");
  app.add_option("--value", arguments.values,
                 "a value to be noted; again for each; default: all that change");
  app.add_option("--seed", arguments.seed, "of sensors' bias, drift and noise")->check(process::refuse_seed);
  app.add_option("--csv", arguments.csv_file, "write the answer as a table")->check(is_file_name);
  app.add_option("--svg", arguments.svg_file, "draw the answer")->check(is_file_name);
  app.add_option("--json", arguments.json_file, "write what the plant has, and how fast it is")
      ->check(is_file_name);
  app.footer("Exit codes: 0 it is in order, 1 wrong input, 2 wrong usage, 5 the solver gave up.");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  if (arguments.file.empty() == !arguments.types) {
    std::fputs("stepwright plant: a FILE, or --types\n", stderr);
    return result::to_int(result::ExitCode::Usage);
  }
  return result::to_int(plant_program::run_plant(arguments));
}

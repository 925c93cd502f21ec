// The process behind `stepwright fleet`.

#include <CLI/CLI.hpp>

#include <map>
#include <string>

#include "programs/fleet/fleet_command.h"
#include "runtime/ground/process/command_line.h"

namespace {

using namespace stepwright;

void describe(CLI::App& app, fleet::FleetArguments& arguments) {
  const std::map<std::string, fleet::Objective> objectives = {
      {"none", fleet::Objective::None},
      {"makespan", fleet::Objective::Makespan},
      {"tardiness", fleet::Objective::TotalTardiness}};
  app.add_option("problem", arguments.problem, "the problem: map, vehicles, goals; or envelopes alone")
      ->required();
  app.add_flag("--paper", arguments.paper,
               "order only what the earliest times bring together, as Pecora and Cirillo 2012 do");
  app.add_option_function<std::string>(
         "--objective",
         [&arguments, objectives](const std::string& word) { arguments.objective = objectives.at(word); },
         "none, makespan or tardiness (default makespan)")
      ->check(CLI::IsMember(objectives));
  app.add_option("--time", arguments.time_s, "time budget of everything in seconds (default 10)")
      ->check(CLI::Validator(process::refuse_seconds, "SECONDS"));
  app.add_option("--path-time", arguments.path_time_s,
                 "find paths by ARA* and improve them for so many seconds (default: A*, the best paths)")
      ->check(CLI::Validator(process::refuse_seconds, "SECONDS"));
  app.add_option("--path-factor", arguments.path_factor,
                 "take paths that are proved to cost at most so many times the least (default 1)")
      ->check(CLI::Range(1.0, 100.0));
  app.add_option("--alternatives", arguments.alternatives,
                 "other paths to try where there is no schedule (default 48; 0: none)")
      ->check(CLI::Range(0u, 100000u));
  app.add_option("--give-way", arguments.give_way,
                 "so many vehicles at most drive out of the way of others first where no path helps "
                 "(default 0)")
      ->check(CLI::Range(0u, 100u));
  app.add_option("--threads", arguments.threads, "for paths and envelopes (default 2)")
      ->check(CLI::Range(1u, 64u));
  app.add_option("--cache", arguments.cache_folder,
                 "where look-up tables of vehicles are kept (default: $XDG_CACHE_HOME/stepwright)");
  app.add_flag("--progress", arguments.progress, "show the progress also where stderr is no terminal");
  app.add_option("--json", arguments.json_file, "write plan and figures as JSON");
  app.add_option("--svg", arguments.svg_file, "draw floor, paths, envelopes, critical sections and times");
  auto* program = app.add_option("--program", arguments.program_file,
                                 "compile the plan to a program for a runtime; it is planned with a reserve "
                                 "for what drives it");
  auto* config = app.add_option("--config", arguments.config,
                                "cell that is to run the program: its terminals, its scan interval (default: "
                                "terminals in a row, 20 ms)")
                     ->needs(program);
  app.add_option("--set", arguments.overrides, "KEY=VALUE that wins over the cell's file")->needs(config);
  app.footer(
      "Exit codes: 0 there is a schedule, 1 wrong input, 2 wrong usage, 3 there is none on any "
      "paths (proved), 4 the budget ended first, or Ctrl-C or SIGTERM came, before there was one; so did all "
      "that was tried, where none is proved for some paths only.");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Plan a fleet: who carries what, on which paths, in which order", "stepwright fleet");
  fleet::FleetArguments arguments;
  describe(app, arguments);
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  return result::to_int(fleet::run_fleet(arguments));
}

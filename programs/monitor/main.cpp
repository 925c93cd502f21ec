// The process behind the commands for people who attend a runtime: start, stop, fault, force, unforce,
// forces, watch, snapshot, step, continue, record, trace.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>

#include "cell/config/cell_options.h"
#include "programs/monitor/commands.h"
#include "runtime/ground/process/command_line.h"

namespace stepwright::monitor {
namespace {

// To the plant what is not a number is the end of a fault.
std::string refuse_no_number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' && std::isfinite(value) ? "" : "'" + text + "' is not a number";
}

// All commands with their arguments; the one that was parsed runs.
class Commands {
 public:
  explicit Commands(CLI::App& app) : app_(app) {
    add_runs();
    add_faults();
    add_forces();
    add_watches();
    add_steps();
    add_recordings();
  }

  int run() const {
    const auto config = config::load_cell(cell_);
    return config ? chosen_(*config) : config.error();
  }

 private:
  CLI::App* add(const char* name, const char* summary, std::function<int(const config::CellConfig&)> work) {
    CLI::App* command = app_.add_subcommand(name, summary);
    config::add_cell_options(*command, cell_);
    command->callback([this, work = std::move(work)] { chosen_ = work; });
    return command;
  }
  static void add_json(CLI::App* command, std::string& file) {
    command->add_option("--json", file, "write the report as JSON");
  }

  void add_runs();
  void add_faults();
  void add_forces();
  void add_watches();
  void add_steps();
  void add_recordings();

  CLI::App& app_;
  config::CellOptions cell_;
  std::function<int(const config::CellConfig&)> chosen_;
  StartArguments start_;
  FaultArguments fault_;
  ForceArguments force_;
  WatchArguments watch_;
  StepArguments step_;
  RecordArguments record_;
  TraceArguments trace_;
};

void Commands::add_runs() {
  CLI::App* command = add("start", "start the loaded program, or leave a fault",
                          [this](const auto& config) { return start(config, start_); });
  command->add_flag("--cold", start_.cold, "retained variables have their initial values too");
  add("stop", "stop the program; its outputs go to their safe state",
      [](const auto& config) { return stop(config); });
}

void Commands::add_faults() {
  CLI::App* command = add("fault", "make a fault of the simulated plant hold, or end it",
                          [this](const auto& config) { return fault(config, fault_); });
  command->add_option("name", fault_.name, "as `stepwright campaign CELL --list` names it")->required();
  auto* value = command->add_option("value", fault_.value, "in the fault's unit")->check(refuse_no_number);
  auto* clear = command->add_flag("--clear", fault_.clear, "it ends");
  value->excludes(clear);
}

void Commands::add_forces() {
  CLI::App* command = add("force", "hold a variable at a value, whatever program and inputs say",
                          [this](const auto& config) { return force(config, force_); });
  command->add_option("name", force_.name, "e.g. MAIN.levels[3], P.timer.PT, %QX0.2")->required();
  command->add_option("value", force_.value, "literal: TRUE, 16#FF, 3.5, T#1s500ms, an enumerator")
      ->required();
  command
      ->add_option("--seconds", force_.seconds, "then it is released by itself (default: not before unforce)")
      ->check(CLI::Validator(process::refuse_seconds, "SECONDS"))
      ->check(CLI::Range(0.001, 3e7));
  command = add("unforce", "release a variable, which keeps its value until something changes it",
                [this](const auto& config) { return unforce(config, force_); });
  auto* name = command->add_option("name", force_.name, "the variable");
  auto* all = command->add_flag("--all", force_.all, "everything that is forced");
  name->excludes(all);
  command->require_option(2, 0);  // --config and one of the two
  command = add("forces", "list what is forced",
                [this](const auto& config) { return list_forces(config, force_); });
  add_json(command, force_.json_file);
}

void Commands::add_watches() {
  CLI::App* command = add("watch", "print values again and again, changed ones with a star",
                          [this](const auto& config) { return watch(config, watch_); });
  command->add_option("names", watch_.names, "variables");
  command->add_option("--list", watch_.list_file, "file with more names, one a line");
  command->add_option("--period", watch_.period_ms, "milliseconds between two looks (default 500)")
      ->check(CLI::Range(1, 3'600'000));
  command->add_option("--count", watch_.count, "looks (default: until interrupted)");
  add_json(command, watch_.json_file);
  command = add("snapshot", "print all values of one scan, or those of some variables",
                [this](const auto& config) { return snapshot(config, watch_); });
  command->add_option("names", watch_.names, "variables (default: all)");
  command->add_option("--list", watch_.list_file, "file with more names, one a line");
  add_json(command, watch_.json_file);
}

void Commands::add_steps() {
  CLI::App* command = add("step", "stand still in simulated time and run some scans",
                          [this](const auto& config) { return step(config, step_); });
  command->add_option("scans", step_.scans, "how many (default 1; 0: only stand still)");
  command->add_flag("--changes", step_.changes, "print the variables that each scan changes");
  add_json(command, step_.json_file);
  add("continue", "end the standing still", [](const auto& config) { return go_on(config); });
}

void Commands::add_recordings() {
  CLI::App* command = add("record", "record everything that decides the scans, for `stepwright replay`",
                          [this](const auto& config) { return record(config, record_); });
  auto* file =
      command->add_option("file", record_.file, "recording to write; one of that name is kept as FILE.1");
  command->add_option("--seconds", record_.seconds, "how long (default: until interrupted)")
      ->check(CLI::Validator(process::refuse_seconds, "SECONDS"))
      ->check(CLI::Range(0.001, 2e6));
  command->add_flag("--detach", record_.detach, "begin, and leave it recording");
  auto* stop = command->add_flag("--stop", record_.stop, "end the recording");
  auto* status = command->add_flag("--status", record_.status, "say how the recording stands");
  command->add_option("--max-mb", record_.max_mb, "keep about this many megabytes, the newest");
  command->add_option("--hash-every", record_.hash_every, "scans between two hashes (default 1)")
      ->check(CLI::Range(1, 1'000'000));
  command->add_option("--keyframe-every", record_.keyframe_every,
                      "scans between two whole images (default 1000)");
  file->excludes(stop)->excludes(status);
  stop->excludes(status);
  command->require_option(2, 0);  // --config and one of the three
  add_json(command, record_.json_file);
  command = add("trace", "write variables as a table, a row for every scan",
                [this](const auto& config) { return trace_to_csv(config, trace_); });
  command->add_option("names", trace_.names, "variables");
  command->add_option("--list", trace_.list_file, "file with more names, one a line");
  command->add_option("--csv", trace_.csv_file, "file for the table")->required();
  command->add_option("--seconds", trace_.seconds, "how long (default 1)")
      ->check(CLI::Validator(process::refuse_seconds, "SECONDS"))
      ->check(CLI::Range(0.001, 86'400.0));
}

}  // namespace
}  // namespace stepwright::monitor

int main(int argc, char** argv) {
  CLI::App app("Look at a running program: force, watch, step, record", "stepwright");
  app.require_subcommand(1);
  const stepwright::monitor::Commands commands(app);
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  return commands.run();
}

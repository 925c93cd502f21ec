// `stepwright binding try [CELL]`: every action of a planned cell alone on its simulated plant, and what the
// plant does otherwise than the domain and the binding say.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "cell/missions/planning/table/planning_table.h"
#include "cell/processes/known_cells.h"
#include "cell/trial/trial.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"

namespace {

using namespace stepwright;
using result::ExitCode;

constexpr std::size_t kMostSeeds = 1000;

std::atomic<bool> cancelled{false};

struct Arguments {
  std::string cell = "cell.toml";
  std::vector<std::string> overrides;
  std::string action;
  std::size_t seeds = 3;
  std::size_t most = 0;
  bool every = false;
  std::string json;
};

// What is tried now: one line that is written over on a terminal; elsewhere nothing.
class TrialLine {
 public:
  ~TrialLine() {
    if (shown_) std::fputs("\r\033[K", stderr);
  }
  void show(const trial::TrialProgress& progress) {
    if (isatty(STDERR_FILENO) == 0) return;
    std::fprintf(stderr, "\r\033[K%zu of %zu: %.60s", progress.done + 1, progress.actions,
                 progress.action.c_str());
    std::fflush(stderr);
    shown_ = true;
  }

 private:
  bool shown_ = false;
};

result::Result<config::CellConfig> load(const Arguments& arguments) {
  const auto file = processes::find_cell(arguments.cell);
  if (!file) return tl::unexpected(file.error());
  auto config = config::load_cell_config(*file, arguments.overrides);
  if (!config) return config;
  if (missions::table_as<missions::PlanningTable>(config->mission.table) != nullptr) return config;
  return result::fail("M0032", {file->string(), 0, 0}, "this cell has no [planning], so no binding",
                      "`stepwright new NAME --plan` writes a cell that has");
}

result::Result<trial::TrialOptions> options_of(const Arguments& arguments) {
  trial::TrialOptions options;
  options.seeds = arguments.seeds;
  options.most = arguments.most;
  options.every = arguments.every;
  options.cancel = &cancelled;
  if (arguments.action.empty()) return options;
  const bool whole = arguments.action.front() == '(';
  options.only = translate::parse_pattern(whole ? arguments.action : "(" + arguments.action + ")");
  if (options.only) return options;
  return result::fail("M0031", {}, "'" + arguments.action + "' is no action",
                      "--action \"(load ?v ?f ?l)\" or one with its objects, \"(load v1 f1 level8)\"");
}

int try_cell(const Arguments& arguments) {
  if (!arguments.json.empty()) {
    if (const auto unwritable = files::check_writable(arguments.json); !unwritable.empty())
      return process::fail(unwritable, ExitCode::BadInput);
  }
  const auto config = load(arguments);
  if (!config) return process::fail(config.error(), ExitCode::BadInput);
  const auto options = options_of(arguments);
  if (!options) return process::fail(options.error(), ExitCode::BadInput);
  std::optional<TrialLine> line(std::in_place);
  const auto report =
      trial::try_binding(*config, *options, [&](const trial::TrialProgress& now) { line->show(now); });
  line.reset();
  if (!report) return process::fail(report.error(), ExitCode::BadInput);
  if (arguments.json != "-") std::fputs(trial::to_text(*report).c_str(), stdout);
  if (!arguments.json.empty()) {
    const auto unwritten = files::write_file(arguments.json, trial::to_json(*report) + "\n");
    if (!unwritten.empty()) return process::fail(unwritten, ExitCode::BadInput);
  }
  const bool wrong = result::has_errors(report->problems);
  if (!report->problems.empty())
    return process::fail(report->problems, wrong ? ExitCode::BadInput : ExitCode::Done);
  return result::to_int(report->cancelled ? ExitCode::BudgetExhausted : ExitCode::Done);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"What a planner's names mean at the terminals of a cell", "stepwright binding"};
  app.require_subcommand(1);
  Arguments arguments;
  CLI::App& command = *app.add_subcommand(
      "try", "run every action alone on the simulated plant, and compare it with the domain and the binding");
  command.add_option("CELL", arguments.cell,
                     "a cell's file, or the name of a cell that comes with Stepwright "
                     "(default: cell.toml of this folder)");
  command.add_option("--set", arguments.overrides,
                     "KEY=VALUE in place of what the cell's file says; again for each");
  command.add_option("--action", arguments.action,
                     "only this action, or those of a pattern: \"(load ?v f1 ?l)\"");
  command
      .add_option("--seeds", arguments.seeds, "runs of each, with seeds from the cell's own on (default 3)")
      ->check(CLI::Range(std::size_t{1}, kMostSeeds));
  command
      .add_option("--most", arguments.most,
                  "so many actions of each entry of the binding (default: all; where there are more than 60, "
                  "so many that every object is tried in every place)")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}));
  command.add_flag("--every", arguments.every, "every ground action, however many there are");
  command.add_option("--json", arguments.json, "write what was found to this file");
  app.footer(
      "Exit codes: 0 the plant does as it is said, 1 it does not, or wrong input, 2 wrong usage, "
      "4 interrupted.");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  std::signal(SIGINT, [](int) { cancelled = true; });
  std::signal(SIGTERM, [](int) { cancelled = true; });
  return try_cell(arguments);
}

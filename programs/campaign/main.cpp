// `stepwright campaign CELL`: a cell many times in simulated time, disturbed at random, every run judged.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cell/campaign/campaign.h"
#include "cell/processes/known_cells.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/interruption.h"
#include "runtime/ground/process/temporary_folder.h"

namespace stepwright::campaign {
namespace {

using process::fail;
using result::ExitCode;

struct Arguments {
  std::string cell;
  CampaignOptions options;
  std::optional<std::uint64_t> only;
  std::vector<std::string> faults;
  double seconds = 60.0;
  bool list = false;
  std::string json_file;
  std::vector<std::string> overrides;
};

void describe(CLI::App& app, Arguments& arguments) {
  CampaignOptions& options = arguments.options;
  options.jobs = std::max(1U, std::thread::hardware_concurrency());
  app.add_option("CELL", arguments.cell, "name of a cell that `demo --list` names, or a cell's .toml file")
      ->required();
  app.add_option("--runs", options.runs, "how many")->check(CLI::Range(1.0, 1e9))->capture_default_str();
  app.add_option("--seed", options.first, "of the first run; each has the next one")
      ->check(process::refuse_seed)
      ->capture_default_str();
  app.add_option("--only", arguments.only, "SEED: repeat this run, and tell all of it")
      ->check(process::refuse_seed);
  app.add_option("--jobs", options.jobs, "runs at once (one for each core)")->check(CLI::Range(1U, 256U));
  app.add_option(
      "--faults", arguments.faults,
      "NAME, where * stands for any text; again for each; none: no faults (all that have a range)");
  app.add_option("--seconds", arguments.seconds, "of a run, where the cell has no planner (60)")
      ->check(process::refuse_seconds);
  app.add_flag("--list", arguments.list, "name the faults that the plant offers, and end");
  app.add_option("--json", arguments.json_file, "write the figures there");
  app.add_option("--set", arguments.overrides, "KEY=VALUE that wins over the cell's file");
  app.footer("Exit codes: 0 no run was lost or violated, 1 wrong input, 4 interrupted, 5 one was.");
}

int list(const CellBase& base) {
  for (const OfferedFault& fault : base.offered)
    fmt::print("{:<32} {:g} to {:g} {}\n", fault.name, fault.range.min, fault.range.max, fault.unit);
  if (base.without_range > 0) fmt::print("{} more have no range and are not tried\n", base.without_range);
  return to_int(ExitCode::Done);
}

bool failed(const CellRun& run) {
  return run.verdict == Verdict::Lost || run.verdict == Verdict::Violated;
}

int write(const Arguments& arguments, const Campaign& campaign) {
  if (arguments.json_file.empty()) return to_int(ExitCode::Done);
  const auto refused = files::write_file(arguments.json_file, to_json(campaign) + "\n");
  return refused.empty() ? to_int(ExitCode::Done) : fail(refused, ExitCode::BadInput);
}

int run_all(const Arguments& arguments, const CellBase& base) {
  const process::Interruption interruption;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto told = [&](std::uint64_t done) {
    if (terminal) fmt::print(stderr, "\r{} of {}", done, arguments.options.runs);
  };
  const Campaign campaign = run_campaign(base, arguments.options, told, interruption.flag());
  if (terminal) fmt::print(stderr, "\n");
  fmt::print("{}", table(campaign));
  if (const int exit = write(arguments, campaign); exit != to_int(ExitCode::Done)) return exit;
  if (!campaign.failures.empty() || failed(campaign.undisturbed)) return to_int(ExitCode::RuntimeFault);
  if (campaign.runs() == arguments.options.runs) return to_int(ExitCode::Done);
  fmt::print(stderr, "interrupted: these are the runs that were done\n");
  return to_int(ExitCode::BudgetExhausted);
}

int repeat(Arguments arguments, const CellBase& base) {
  arguments.options.first = *arguments.only;
  arguments.options.runs = 1;
  arguments.options.jobs = 1;
  const Campaign campaign = run_campaign(base, arguments.options);
  fmt::print("{}", story(campaign.last));
  if (const int exit = write(arguments, campaign); exit != to_int(ExitCode::Done)) return exit;
  return to_int(failed(campaign.last) ? ExitCode::RuntimeFault : ExitCode::Done);
}

int run(Arguments arguments) {
  if (!arguments.json_file.empty()) {
    const auto refused = files::check_writable(arguments.json_file);
    if (!refused.empty()) return fail(refused, ExitCode::BadInput);
  }
  const auto file = processes::find_cell(arguments.cell);
  if (!file) return fail(file.error(), ExitCode::BadInput);
  const process::TemporaryFolder states(config::temporary_folder());
  if (states.path().empty()) {
    return fail(result::fail("M0042", {config::temporary_folder().string(), 0, 0},
                             "no folder for the state of the runs can be made here")
                    .value(),
                ExitCode::BadInput);
  }
  auto base = prepare({*file, arguments.overrides, states.path(), arguments.seconds});
  if (!base) return fail(base.error(), ExitCode::BadInput);
  arguments.options.disturbed = arguments.faults != std::vector<std::string>{"none"};
  if (arguments.options.disturbed) {
    auto wanted = chosen(base->offered, arguments.faults);
    if (!wanted) return fail(wanted.error(), ExitCode::BadInput);
    base->offered = std::move(*wanted);
  }
  if (arguments.list) return list(*base);
  return arguments.only ? repeat(std::move(arguments), *base) : run_all(arguments, *base);
}

}  // namespace
}  // namespace stepwright::campaign

int main(int argc, char** argv) {
  CLI::App app("Runs of a cell with random faults, each judged by the plant's truth", "stepwright campaign");
  stepwright::campaign::Arguments arguments;
  stepwright::campaign::describe(app, arguments);
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  return stepwright::campaign::run(std::move(arguments));
}

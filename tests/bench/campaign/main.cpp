// The stochastic campaign: simulated runs of the tank bench with random faults, demands and sensor errors, of
// the sorting line with random faults, of a fleet or of two arms to which something happens at a random
// moment, as fast as the machine allows. Every run must end at the goal or in the safe state with the right
// report; the undisturbed class is the baseline of costs and times beside the disturbed ones.
//
//   bench_campaign [--cell bench|conveyor|fleet|robot_cell] [--runs N] [--first SEED] [--threads N] [--json
//   FILE]
//
// Ctrl-C ends it after the runs that are under way, with the table of those that are done (exit 4).
// A single seed again: --first SEED --runs 1.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>

#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/interruption.h"
#include "tests/bench/campaign/arms.h"
#include "tests/bench/campaign/campaign.h"
#include "tests/bench/campaign/fleet.h"
#include "tests/bench/campaign/line.h"

namespace stepwright::campaign {
namespace {

using process::fail;
using result::ExitCode;

struct Arguments {
  std::string cell = "bench";
  std::uint64_t first = 0;
  std::uint64_t runs = 1'000;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  std::string json_file;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.add_option("--cell", arguments.cell, "bench, conveyor, fleet or robot_cell (bench)")
      ->check(CLI::IsMember({"bench", "conveyor", "fleet", "robot_cell"}));
  app.add_option("--runs", arguments.runs, "how many (1000)")->check(CLI::Range(1.0, 1e9));
  app.add_option("--first", arguments.first, "seed of the first one (0)")->check(CLI::NonNegativeNumber);
  app.add_option("--threads", arguments.threads, "that run them (one for each core)")
      ->check(CLI::Range(1U, 1'024U));
  app.add_option("--json", arguments.json_file, "write the figures there");
}

int finish(const Arguments& arguments, const std::string& table, const std::string& json, bool lost,
           bool interrupted) {
  std::fputs(table.c_str(), stdout);
  if (!arguments.json_file.empty()) {
    const auto failed = files::write_file(arguments.json_file, json + "\n");
    if (!failed.empty()) return fail(failed, ExitCode::BadInput);
  }
  if (interrupted) std::fprintf(stderr, "interrupted: these are the runs that were done\n");
  if (lost) return to_int(ExitCode::RuntimeFault);
  return to_int(interrupted ? ExitCode::BudgetExhausted : ExitCode::Done);
}

std::function<void(std::uint64_t)> progress_of(const Arguments& arguments) {
  return [runs = arguments.runs](std::uint64_t done) {
    std::fprintf(stderr, "\r%llu of %llu", static_cast<unsigned long long>(done),
                 static_cast<unsigned long long>(runs));
  };
}

// `campaign`: line_campaign, fleet_campaign or arms_campaign.
template <typename Campaign>
int run_cell(const Arguments& arguments, Campaign campaign) {
  const process::Interruption interruption;
  const auto figures = campaign(arguments.first, arguments.runs, arguments.threads, progress_of(arguments),
                                interruption.flag());
  std::fprintf(stderr, "\n");
  return finish(arguments, table(figures), to_json(figures, arguments.first, arguments.threads),
                !figures.lost.empty(), figures.runs() < arguments.runs);
}

int run_bench(const Arguments& arguments) {
  const auto planning = campaign_planning();
  if (!planning) return fail(planning.error(), ExitCode::BadInput);
  const process::Interruption interruption;
  const Figures figures = campaign(*planning, arguments.first, arguments.runs, arguments.threads,
                                   progress_of(arguments), interruption.flag());
  std::fprintf(stderr, "\n");
  return finish(arguments, table(figures), to_json(figures, arguments.first, arguments.threads),
                !figures.lost.empty(), figures.all().runs < arguments.runs);
}

int run(const Arguments& arguments) {
  if (!arguments.json_file.empty()) {
    const auto refused = files::check_writable(arguments.json_file);
    if (!refused.empty()) return fail(refused, ExitCode::BadInput);
  }
  if (arguments.cell == "conveyor") return run_cell(arguments, line_campaign);
  if (arguments.cell == "robot_cell") return run_cell(arguments, arms_campaign);
  return arguments.cell == "fleet" ? run_cell(arguments, fleet_campaign) : run_bench(arguments);
}

}  // namespace
}  // namespace stepwright::campaign

int main(int argc, char** argv) {
  CLI::App app("Runs of a cell, disturbed at random and judged by the plant's truth", "bench_campaign");
  stepwright::campaign::Arguments arguments;
  stepwright::campaign::describe(app, arguments);
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  return stepwright::campaign::run(arguments);
}

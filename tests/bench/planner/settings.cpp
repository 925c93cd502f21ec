#include "tests/bench/planner/settings.h"

#include <CLI/CLI.hpp>

#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::bench {
namespace {

constexpr const char* kLama = " --plan-file {plan} --alias lama-first {domain} {problem}";

// "NAME=COMMAND"
std::optional<Outside> outside_from(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos) return std::nullopt;
  return Outside{text.substr(0, equals), text.substr(equals + 1), false};
}

}  // namespace

std::optional<Settings> settings_from(int argc, char** argv, int& exit_code) {
  Settings settings;
  settings.best_file = std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/bench/planner/best_known.json";
  double time_s = 0.0, outside_s = 30.0;
  std::size_t memory_mb = 0;
  bool full = false;
  std::string fast_downward;
  std::vector<std::string> outside;
  CLI::App app(
      "The planner over instances of many domains, beside a textbook planner and planners found outside");
  app.add_option("--time", time_s, "seconds for each planner and instance (2; --scale 10; --full 300)")
      ->check(CLI::Validator(process::refuse_seconds, "SECONDS"));
  app.add_option("--memory", memory_mb, "MB for each (4096; --full 20480)")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 24));
  app.add_option("--domains", settings.domains, "only these, separated by commas")->delimiter(',');
  app.add_option("--sizes", settings.sizes, "only the first so many sizes of each domain")
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", settings.seed, "of the generators (1)")->check(CLI::NonNegativeNumber);
  app.add_option("--json", settings.json_file, "the report as JSON");
  app.add_option("--write", settings.write_folder, "writes the instances as PDDL files");
  app.add_option("--best", settings.best_file, "the file of best known costs");
  app.add_flag("--update-best", settings.update_best, "writes better costs and bounds back to it");
  app.add_flag("!--no-baseline", settings.baseline, "without the textbook planner");
  app.add_option("--fast-downward", fast_downward,
                 "path of fast-downward.py: LAMA's first iteration, classical only");
  app.add_option("--outside", outside,
                 "NAME=COMMAND with {domain} {problem} {plan}: a planner on all instances");
  app.add_option("--outside-time", outside_s, "seconds for each planner from outside (30)")
      ->check(CLI::Validator(process::refuse_seconds, "SECONDS"));
  app.add_flag("--scale", settings.scale, "growing sizes until a limit ends them, instead of the table");
  app.add_option("--svg", settings.svg_folder, "pictures of the curves");
  app.add_flag("--full", full,
               "limits of 300 s and 20 GiB, of 24: the bench itself holds instances and judges plans");
  app.add_option("--repeats", settings.repeats, "of the measurements on the tank bench (9)")
      ->check(CLI::PositiveNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool help = error.get_exit_code() == 0;
    exit_code = result::to_int(help ? result::ExitCode::Done : result::ExitCode::Usage);
    app.exit(error);
    return std::nullopt;
  }
  for (const std::string& text : outside) {
    const auto planner = outside_from(text);
    if (!planner) {
      std::fprintf(stderr, "--outside wants NAME=COMMAND, not '%s'\n", text.c_str());
      exit_code = result::to_int(result::ExitCode::Usage);
      return std::nullopt;
    }
    settings.outside.push_back(*planner);
  }
  if (!fast_downward.empty())
    settings.outside.push_back({"lama_first", "'" + fast_downward + "'" + kLama, true});
  if (time_s <= 0.0) time_s = full ? 300.0 : settings.scale ? 10.0 : 2.0;
  if (memory_mb == 0) memory_mb = full ? 20480 : 4096;
  settings.limits.time = std::chrono::milliseconds(static_cast<std::int64_t>(time_s * 1000.0));
  settings.outside_time = std::chrono::milliseconds(static_cast<std::int64_t>(outside_s * 1000.0));
  settings.limits.memory_mb = memory_mb;
  settings.limits.first_only = settings.scale;
  return settings;
}

}  // namespace stepwright::bench

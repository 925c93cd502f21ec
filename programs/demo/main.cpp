// `stepwright demo CELL`: all processes of a cell, its main job, a report.

#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>

#include "cell/config/cell_config.h"
#include "cell/processes/known_cells.h"
#include "programs/demo/cell_run.h"
#include "programs/demo/controller_choice.h"
#include "programs/demo/summary.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/stop_signal.h"

namespace stepwright::demo {
namespace {

using process::fail;
using result::ExitCode;

std::atomic<bool> stop_requested{false};

struct DemoOptions {
  std::string cell = "bench";
  bool headless = false;
  bool fast = false;
  bool sequential = false;
  bool compare = true;
  bool list = false;
  std::optional<std::uint64_t> seed;
  std::optional<int> port;
  std::string json;
  std::string pictures;
  std::string state_dir;
  std::string controller;
  std::vector<std::string> faults;
  std::vector<std::string> overrides;
};

// "leak_a1=0.5@12" -> {at_s = 12, name = "leak_a1", value = 0.5}
result::Result<std::string> fault_toml(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::size_t at = text.rfind('@');
  char* end = nullptr;
  if (equals != std::string::npos && at != std::string::npos && equals < at) {
    const std::string value = text.substr(equals + 1, at - equals - 1);
    const std::string when = text.substr(at + 1);
    const bool numbers = !value.empty() && !when.empty() &&
                         (std::strtod(value.c_str(), &end), *end == '\0') &&
                         (std::strtod(when.c_str(), &end), *end == '\0');
    if (numbers) return "{at_s=" + when + ",name=\"" + text.substr(0, equals) + "\",value=" + value + "}";
  }
  return result::fail("M0003", {}, "'" + text + "' is not NAME=VALUE@SECONDS",
                      "for example --fault leak_a1=0.5@12");
}

result::Result<std::vector<std::string>> overrides_of(const DemoOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (options.fast) overrides.emplace_back("clock.speed=0");
  if (options.seed) overrides.push_back("plant.seed=" + std::to_string(*options.seed));
  if (options.port) overrides.push_back("hmi.port=" + std::to_string(*options.port));
  std::string faults;
  for (const std::string& text : options.faults) {
    auto fault = fault_toml(text);
    if (!fault) return result::forward(fault);
    faults += (faults.empty() ? "" : ",") + *fault;
  }
  if (!faults.empty()) overrides.push_back("faults=[" + faults + "]");
  return overrides;
}

std::filesystem::path make_state_dir() {
  std::string pattern = (config::temporary_folder() / "stepwright-XXXXXX").string();
  return mkdtemp(pattern.data()) == nullptr ? std::filesystem::path() : std::filesystem::path(pattern);
}

// What all runs of a demo share.
struct Setting {
  std::filesystem::path cell;
  bool page = false;
  std::string scan = "runtime";
  std::optional<EmulatedController> emulator;
};

// Runs in `kept`, or in a temporary folder if that is empty.
result::Result<CellRunResult> run_once(const Setting& setting, std::vector<std::string> overrides,
                                       const std::filesystem::path& kept, int run_number) {
  std::error_code error;
  const std::filesystem::path state_dir =
      kept.empty() ? make_state_dir() : std::filesystem::absolute(kept, error);
  std::filesystem::create_directories(state_dir, error);
  // The report of an earlier run in this folder must not pass for one of this run.
  if (!error) std::filesystem::remove(state_dir / "report.json", error);
  if (state_dir.empty() || error) {
    return result::fail("M0004", {state_dir.string(), 0, 0}, "the state folder cannot be made or used");
  }
  overrides.push_back("cell.state_dir=\"" + state_dir.string() + "\"");
  // Several demos may run on one machine, and there are fewer domains than processes: what one sends must not
  // reach the runtime of another. Whoever sets these values himself comes later in the list and wins.
  const std::string run = std::to_string(getpid()) + "-" + std::to_string(run_number);
  overrides.insert(overrides.begin(),
                   {"dds.runtime_id=demo-" + run,
                    "dds.domain_id=" + std::to_string(10 + (getpid() * 2 + run_number) % 90)});
  auto result = CellRun({setting.cell, overrides, state_dir, setting.page, setting.scan, setting.emulator})
                    .run(stop_requested);
  if (kept.empty()) {  // what is left over does no harm
    config::CellConfig ended;
    ended.state_dir = state_dir;
    std::filesystem::remove(ended.plant_memory_path(), error);
    std::filesystem::remove_all(state_dir, error);
  }
  return result;
}

// The demo has a code of its own for what it cannot write.
result::Result<void> written(const result::Diagnostics& failed) {
  if (failed.empty()) return {};
  return result::fail("M0005", failed.front().where, failed.front().message, failed.front().hint);
}

result::Result<void> write_file(const std::filesystem::path& file, const std::string& text) {
  return written(files::write_file(file.string(), text));
}

constexpr const char* kSchedulePicture = "gantt.svg";
constexpr const char* kCostPicture = "cost.svg";

// Before the run and not after it, which may take an hour.
result::Result<void> check_outputs(const DemoOptions& options) {
  if (!options.json.empty()) {
    if (auto json = written(files::check_writable(options.json)); !json) return json;
  }
  if (options.pictures.empty()) return {};
  const std::filesystem::path folder = options.pictures;
  std::error_code ignored;  // a missing folder is noticed at the picture
  std::filesystem::create_directories(folder, ignored);
  return written(files::check_writable((folder / kSchedulePicture).string()));
}

result::Result<void> write_pictures(const std::filesystem::path& folder, const run::RunRecord& record) {
  if (auto done = write_file(folder / kSchedulePicture, run::gantt_svg(record)); !done) return done;
  return write_file(folder / kCostPicture, run::cost_svg(record));
}

// A device that is known only when the emulator runs, so that the configuration can be read before.
constexpr const char* kDeviceToCome = "controller.device=\"/dev/null\"";

int run_demo(const DemoOptions& options) {
  auto cell = processes::find_cell(options.cell);
  if (!cell) return fail(cell.error(), ExitCode::BadInput);
  auto overrides = overrides_of(options);
  if (!overrides) return fail(overrides.error(), ExitCode::Usage);
  Setting setting{*cell, !options.headless, "runtime", std::nullopt};
  if (!options.controller.empty()) {
    auto choice =
        choose_controller(options.controller, std::filesystem::read_symlink("/proc/self/exe").parent_path());
    if (!choice) return fail(choice.error(), ExitCode::BadInput);
    overrides->insert(overrides->end(), choice->overrides.begin(), choice->overrides.end());
    setting.emulator = std::move(choice->emulator);
  }
  std::vector<std::string> first = *overrides;
  if (setting.emulator) first.emplace_back(kDeviceToCome);
  auto config = config::load_cell_config(*cell, first);
  if (!config) return fail(config.error(), ExitCode::BadInput);
  if (config->controller.remote()) setting.scan = "gateway";
  if (setting.emulator && config->clock.mode == config::ClockMode::Simulated)
    count_instructions(*setting.emulator);
  if (auto writable = check_outputs(options); !writable) return fail(writable.error(), ExitCode::BadInput);
  const missions::MissionTable* const mission = config->mission.table.get();
  if (mission == nullptr) {
    return fail(
        result::Diagnostics{{.code = "M0011",
                             .where = {cell->string(), 0, 0},
                             .message = "this cell has no planner, so that it has no main job to show",
                             .hint = "stepwright up " + cell->string() + " runs its processes"}},
        ExitCode::BadInput);
  }
  const std::string in_sequence = mission->in_sequence();
  if (options.sequential && in_sequence.empty()) {
    return fail(result::Diagnostics{{.code = "M0009",
                                     .where = {cell->string(), 0, 0},
                                     .message = "the planner of this cell has no strictly sequential charts",
                                     .hint = "leave --sequential out"}},
                ExitCode::Usage);
  }
  if (options.sequential) overrides->push_back(in_sequence);
  // What people would have to see to ends a run at which nobody can look; whoever sets the value himself
  // wins.
  if (options.headless) {
    const auto unattended = mission->unattended();
    overrides->insert(overrides->begin(), unattended.begin(), unattended.end());
  }
  auto run = run_once(setting, *overrides, options.state_dir, 0);
  if (!run) return fail(run.error(), ExitCode::RuntimeFault);
  std::optional<CellRunResult> sequential;
  // Two charts are compared on the host: on a controller that says the same and takes its time.
  const bool compare =
      options.compare && !in_sequence.empty() && !options.sequential && !config->controller.remote();
  if (run->report && run->exit == ExitCode::Done && compare && !stop_requested) {
    std::vector<std::string> strict = *overrides;
    strict.push_back(in_sequence);
    strict.emplace_back("clock.speed=0");
    Setting again = setting;
    again.page = false;
    if (auto second = run_once(again, strict, {}, 1)) sequential = std::move(*second);
  }
  if (run->report && options.headless) std::printf("%s", run::report_table(run->report->record).c_str());
  std::fprintf(run->report ? stdout : stderr, "%s", summary_text(*run, sequential).c_str());
  if (!options.json.empty()) {
    auto written = write_file(options.json, summary_json(*run, sequential) + "\n");
    if (!written) return fail(written.error(), ExitCode::BadInput);
  }
  if (!options.pictures.empty() && run->report) {
    auto written = write_pictures(options.pictures, run->report->record);
    if (!written) return fail(written.error(), ExitCode::BadInput);
  }
  return to_int(run->exit);
}

int demo_main(int argc, char** argv) {
  CLI::App app{"Run a cell: all its processes, its main job, a report", "stepwright demo"};
  DemoOptions options;
  app.add_option("CELL", options.cell, "name of a cell that --list names, or a cell's .toml file");
  app.add_flag("--list", options.list, "name the cells that come with Stepwright, and end");
  app.add_flag("--headless", options.headless, "without the web page; ends with the run");
  app.add_flag("--fast", options.fast, "simulated time as fast as the machine allows");
  app.add_flag("--sequential", options.sequential, "a strictly sequential chart, as in the paper");
  app.add_flag("!--no-compare", options.compare, "no second, sequential run for comparison");
  app.add_option("--seed", options.seed, "seed of the sensors' uncertainty")->check(process::refuse_seed);
  app.add_option(
      "--controller", options.controller,
      "where the program runs instead of this host: qemu, a serial device, or HOST:PORT of Modbus");
  app.add_option("--port", options.port, "port of the web page")->check(CLI::Range(0, 65'535));
  app.add_option("--json", options.json, "write the figures to this file");
  app.add_option("--pictures", options.pictures, "write gantt.svg and cost.svg into this folder");
  app.add_option("--state-dir", options.state_dir, "keep logs, journal and report in this folder");
  app.add_option("--fault", options.faults, "NAME=VALUE@SECONDS: a fault of the plant, or a changed demand");
  app.add_option("--set", options.overrides, "KEY=VALUE that wins over the cell's file");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  if (options.list) {
    for (const std::string& name : processes::known_cells()) std::puts(name.c_str());
    return to_int(ExitCode::Done);
  }
  return run_demo(options);
}

}  // namespace
}  // namespace stepwright::demo

int main(int argc, char** argv) {
  struct sigaction action {};
  action.sa_handler = [](int) { stepwright::demo::stop_requested = true; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  if (stepwright::process::ends_on_hangup()) sigaction(SIGHUP, &action, nullptr);
  return stepwright::demo::demo_main(argc, argv);
}

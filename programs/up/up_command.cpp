#include "programs/up/up_command.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <thread>

#include "cell/config/state_dir.h"
#include "cell/processes/process_list.h"
#include "programs/up/cell_lock.h"
#include "programs/up/compile_step.h"
#include "programs/up/detached.h"
#include "programs/up/process_supervisor.h"
#include "runtime/ground/log/rotating_file.h"
#include "runtime/ground/process/command_line.h"

namespace stepwright::up {
namespace {

using process::fail;
using result::ExitCode;

constexpr const char* kLog = "up.log";

result::Diagnostics check(const config::CellConfig& config, const Options& options) {
  if (options.watch && config.boot.sources.empty())
    return {{"M0017",
             result::Severity::Error,
             {config.file.string(), 0, 0},
             "--watch: the cell names no sources that could be saved",
             "[runtime] sources = [\"main.st\"]"}};
  if (options.watch && config.controller.remote())
    return {{"M0017",
             result::Severity::Error,
             {config.file.string(), 0, 0},
             "--watch: a controller behind Modbus takes no online change",
             "leave --watch out"}};
  return {};
}

// Where a process that has no terminal any more goes on with what standard output has been; the set-up token
// stands in it.
std::unique_ptr<log::RotatingFile> log_of(const config::CellConfig& config, const Options& options) {
  if (!options.detach) return nullptr;
  auto file =
      log::RotatingFile::open(config.state_dir / kLog, {.max_bytes = 16u << 20, .keep = 1, .mode = 0600});
  return file ? std::move(*file) : nullptr;
}

bool sources_can_be_read(const config::CellConfig& config) {
  return std::ranges::all_of(config.boot.sources,
                             [](const auto& source) { return access(source.c_str(), R_OK) == 0; });
}

int keep_up(const config::CellConfig& config, const Options& options, Detached& detached) {
  const process::StopSignal stop(process::OnHangup::End);
  std::error_code unknown;  // then the first program is told as missing
  const auto programs = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
  std::vector<std::string> names = processes::starting_order(config);
  names.emplace_back("watch");
  Console console(names, log_of(config, options));
  auto supervisor = ProcessSupervisor::make({.config = config,
                                             .overrides = overrides_of(options),
                                             .programs = programs,
                                             .watch = options.watch,
                                             .terminal = !options.detach,
                                             .on_up = [&detached](ExitCode exit) { detached.up(exit); }},
                                            console);
  if (!supervisor) {
    const int exit = fail(supervisor.error(), ExitCode::RuntimeFault);
    console.say("the cell '" + config.name + "' is not up");
    return exit;
  }
  const auto compiled = compile(config, programs, stop);
  if (!compiled) {
    const int exit = fail(compiled.error(), ExitCode::RuntimeFault);
    console.say("the cell '" + config.name + "' is not up");
    return exit;
  }
  if (*compiled != ExitCode::Done) {
    console.say(
        "the cell '" + config.name + "' is not up: " +
        (sources_can_be_read(config) ? "its program does not compile" : "its sources cannot be read"));
    return to_int(*compiled);
  }
  return to_int((*supervisor)->run(stop));
}

}  // namespace

int run_up(const Options& options) {
  const auto config = load(options);
  if (!config) return fail(config.error(), ExitCode::BadInput);
  if (const auto problems = check(*config, options); !problems.empty())
    return fail(problems, ExitCode::Usage);
  if (auto claimed = config::claim_state_dir(*config); !claimed)
    return fail(claimed.error(), ExitCode::BadInput);
  const auto lock = take_cell(*config);
  if (!lock) return fail(lock.error(), ExitCode::BadInput);
  Detached detached;
  if (options.detach) {
    const auto exit = detached.leave(config->state_dir / kLog);
    if (!exit) return fail(exit.error(), ExitCode::RuntimeFault);
    if (*exit) return **exit;
  }
  return keep_up(*config, options, detached);
}

}  // namespace stepwright::up

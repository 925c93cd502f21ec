// `stepwright runtime --config CELL.toml`: the scan process of a cell. It runs whatever program is downloaded
// through its socket, against the cell's plant, and depends on no other process. SIGTERM ends it with safe
// outputs.

#include <malloc.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>

#include "cell/config/cell_options.h"
#include "cell/config/state_dir.h"
#include "cell/monitor_check/missing_monitors.h"
#include "cell/runtime/boot_program.h"
#include "cell/runtime/cell_io.h"
#include "cell/runtime/guard_watch.h"
#include "cell/runtime/host_options.h"
#include "cell/runtime/io_watch.h"
#include "cell/runtime/process_monitor.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/notify_socket.h"
#include "runtime/ground/process/reload_signal.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/host/host_runtime.h"
#include "runtime/host/thread_stacks.h"
#include "runtime/service/server.h"

namespace stepwright::cell_runtime {
namespace {

using process::fail;
using result::ExitCode;

std::string describe(const config::ClockConfig& clock) {
  if (clock.mode == config::ClockMode::Real) return "real clock";
  if (clock.speed == 0.0) return "simulated clock, as fast as possible";
  char text[64];
  std::snprintf(text, sizeof text, "simulated clock, %g times real time", clock.speed);
  return text;
}

// The folder of the socket. A plant that was kept for an earlier folder of the name is not this one's.
result::Result<void> make_state_dir(const config::CellConfig& config) {
  auto made = config::claim_state_dir(config);
  if (!made) return result::forward(made);
  std::error_code ignored;  // what cannot be removed cannot be opened either
  if (*made) std::filesystem::remove(config.plant_memory_path(), ignored);
  return {};
}

// From the first scan on, if the configuration asks for it.
result::Result<void> begin_recording(host::HostRuntime& runtime, const config::RecordConfig& config) {
  constexpr std::uint64_t kMegabyte = 1'000'000;
  constexpr std::uint64_t kNobodysTicket = 0;
  if (config.file.empty()) return {};
  record::RecordingOptions options;
  options.file = config.file;
  options.max_bytes = config.max_mb * kMegabyte;
  options.hash_every = config.hash_every;
  options.keyframe_every = config.keyframe_every;
  return runtime.record(kNobodysTicket, options);
}

// A program that is started before its devices are there would be in its safe state at once, until somebody
// starts it. After a power failure everything comes up together: it gets some time.
void wait_for_devices(const config::CellConfig& config, const CellIo& io, const process::StopSignal& stop,
                      log::Logger& log) {
  if (!config.safety.io.modbus || !config.boot.autostart || io.alive()) return;
  const auto patience = config.modbus_client.startup;
  log.info("waits", "the program waits for its devices, " + std::to_string(patience.count()) + " ms at most");
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!io.alive() && std::chrono::steady_clock::now() < deadline) {
    if (stop.wait_for(std::chrono::milliseconds(10))) return;
  }
}

int run(const config::CellConfig& config) {
  if (config.controller.remote()) {
    return fail(result::fail("C0564", config.controller.where,
                             "this cell's program runs on a controller behind Modbus", "`stepwright gateway`")
                    .value(),
                ExitCode::BadInput);
  }
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk, not the end
  static_cast<void>(host::limit_thread_stacks());  // a refusal costs memory only
  // One heap for all threads: what the preparation of a program took goes back to the system, and no 64 MiB
  // of address space for each thread count as locked.
  static_cast<void>(mallopt(M_ARENA_MAX, 1));
  const process::StopSignal stop;
  process::ReloadSignal reload;
  process::NotifySocket init;
  auto opened = log::Logger::open("runtime", config.log);
  if (!opened) return fail(opened.error(), ExitCode::BadInput);
  log::Logger& log = **opened;
  auto options = host_options(config);
  if (!options) return fail(options.error(), ExitCode::BadInput);
  if (auto made = make_state_dir(config); !made) return fail(made.error(), ExitCode::BadInput);
  auto io = CellIo::create(config);
  if (!io) return fail(io.error(), ExitCode::BadInput);
  GuardWatch guard(config, **io, log);
  if (auto started = guard.start(); !started) return fail(started.error(), ExitCode::RuntimeFault);

  auto runtime = host::HostRuntime::create(*options, (*io)->driver(), (*io)->plant());
  if (!runtime) return fail(runtime.error(), ExitCode::RuntimeFault);
  ProcessMonitor monitor(config, log, init);
  BootProgram boot(config.boot, **runtime, [&config](std::span<const std::byte> container) {
    return cell_monitors::missing_monitors(config, container);
  });
  auto server = service::Server::create(
      {config.socket_path(), config.supervisor_lost_after, STEPWRIGHT_VERSION, &monitor, boot.persistence()},
      **runtime);
  if (!server) return fail(server.error(), ExitCode::BadInput);
  monitor.attach(**server, **runtime);
  IoWatch watch(config, **io, **runtime, log);
  monitor.attach(watch);
  wait_for_devices(config, **io, stop, log);
  // Only now: the socket says that this is the one runtime of the folder, and so of what is retained in it.
  if (const auto problems = boot.run(); !problems.empty()) log.error("boot", result::to_string(problems));
  // Not before the socket is this one's: the recording of another runtime would be put aside.
  if (auto recording = begin_recording(**runtime, config.record); !recording) {
    return fail(recording.error(), ExitCode::BadInput);
  }
  const std::string listens = "runtime '" + config.name + "' listens on " + config.socket_path().string() +
                              " (" + describe(config.clock) + ")";
  log.info("listens", listens, {{"cell", config.name}, {"socket", config.socket_path().string()}});
  if (const std::string detail = (*runtime)->status().detail; !detail.empty()) {
    log.warning("note", "note: " + detail);
  }
  init.ready(listens);
  while (!stop.came()) {
    (*server)->turn(service::kStatusPeriod, stop.descriptor());
    if (reload.take()) (void)monitor.reload();
    monitor.turn();
    watch.turn();
    guard.turn();
    (*runtime)->set_note("guard", guard.note());
  }
  init.stopping();
  // Safe outputs and their release first: everything else at the end may wait for a disk.
  (*runtime)->end();
  log.info("ends", "runtime '" + config.name + "' ends");
  return to_int(ExitCode::Done);
}

}  // namespace
}  // namespace stepwright::cell_runtime

int main(int argc, char** argv) {
  CLI::App app{"The scan process of a cell", "stepwright runtime"};
  stepwright::config::CellOptions options;
  stepwright::config::add_cell_options(app, options);
  bool concerned = false;
  app.add_flag("--concerned", concerned,
               "only tell by the exit code whether this cell's program is for this process: 0 yes, 1 no");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  if (concerned) {
    return to_int(stepwright::config::concerned(
        options, [](const stepwright::config::CellConfig& cell) { return !cell.controller.remote(); }));
  }
  const auto config = stepwright::config::load_cell(options);
  return config ? stepwright::cell_runtime::run(*config) : config.error();
}

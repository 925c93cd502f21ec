// `stepwright gateway --config CELL.toml`: serves a controller that is reached over Modbus only as a runtime.
// It listens on the socket of the cell's runtime, so that link, supervisor, page and tools need to know
// nothing of it. SIGTERM ends it with the controller stopped.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "cell/config/cell_options.h"
#include "cell/config/reload_log.h"
#include "cell/config/state_dir.h"
#include "cell/gateway/controller_line.h"
#include "cell/gateway/follow_plan.h"
#include "cell/gateway/gateway_metrics.h"
#include "cell/metrics_server/metrics_server.h"
#include "cell/runtime/cell_io.h"
#include "cell/runtime/process_monitor.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/notify_socket.h"
#include "runtime/ground/process/reload_signal.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/remote/remote_runtime.h"
#include "runtime/service/server.h"

namespace stepwright::gateway {
namespace {

using process::fail;
using result::ExitCode;
using std::chrono::milliseconds;

constexpr milliseconds kLook{20};

// The line in the log: found, lost, and why.
class LineJournal {
 public:
  explicit LineJournal(log::Logger& log) : log_(log) {}

  void look(const remote::RemoteRuntime& runtime, const std::string& where) {
    const std::string problem = runtime.line_problem();
    const bool contact = runtime.contact();
    if (contact == contact_ && problem == problem_) return;
    if (contact && !contact_) log_.info("controller", "the controller answers on " + where);
    if (!contact && !problem.empty()) log_.warning("controller", "no controller: " + problem);
    contact_ = contact;
    problem_ = problem;
  }

 private:
  log::Logger& log_;
  bool contact_ = false;
  std::string problem_;
};

result::Result<std::unique_ptr<metrics::MetricsServer>> serve_figures(const config::CellConfig& config,
                                                                      const GatewayFigures& figures,
                                                                      log::Logger& log) {
  auto server = metrics::MetricsServer::start(config.controller.metrics, "controller.metrics",
                                              [&figures] { return figures.text(); });
  if (server && !(*server)->address().empty()) log.info("metrics", "figures at " + (*server)->address());
  return server;
}

// The controller's program was loaded by hand: nothing but its plan is followed.
int run_by_hand(const config::CellConfig& config, log::Logger& log, const process::StopSignal& stop,
                process::ReloadSignal& reload, process::NotifySocket& init) {
  auto plan = read_hand_plan(config.controller.plan);
  if (!plan) return fail(plan.error(), ExitCode::BadInput);
  auto line = make_line(config.controller);
  if (!line) return fail(line.error(), ExitCode::BadInput);
  GatewayFigures figures(config.dds.runtime_id);
  auto http = serve_figures(config, figures, log);
  if (!http) return fail(http.error(), ExitCode::BadInput);
  config::CellConfig running = config;
  process::Heartbeat heartbeat(init);
  init.ready("follows the plan on " + (*line)->name());
  const ExitCode code = follow_plan(config, *plan, **line, log, stop, [&](const FollowStatus& status) {
    figures.publish(status, plan->actions.size());
    if (reload.take()) config::reload_log(running, log, init);
    heartbeat.turn();
  });
  init.stopping();
  return to_int(code);
}

// False: it is to end.
bool find_controller(const remote::RemoteRuntime& runtime, LineJournal& journal, const std::string& where,
                     const process::StopSignal& stop, const std::function<void()>& meanwhile) {
  while (!runtime.wait_for_controller(kLook)) {
    if (stop.came()) return false;
    journal.look(runtime, where);
    meanwhile();
  }
  return true;
}

int serve(const config::CellConfig& config, log::Logger& log, const process::StopSignal& stop,
          process::ReloadSignal& reload, process::NotifySocket& init) {
  auto options = remote_options(config);
  if (!options) return fail(options.error(), ExitCode::BadInput);
  if (auto made = config::claim_state_dir(config); !made) return fail(made.error(), ExitCode::BadInput);
  auto io = cell_runtime::CellIo::create(config);
  if (!io) return fail(io.error(), ExitCode::BadInput);
  auto line = make_line(config.controller);
  if (!line) return fail(line.error(), ExitCode::BadInput);
  const std::string where = (*line)->name();
  GatewayFigures figures(config.dds.runtime_id);
  auto http = serve_figures(config, figures, log);
  if (!http) return fail(http.error(), ExitCode::BadInput);

  auto runtime = remote::RemoteRuntime::create(*options, std::move(*line), (*io)->driver(), (*io)->plant());
  if (!runtime) return fail(runtime.error(), ExitCode::RuntimeFault);
  cell_runtime::ProcessMonitor monitor(config, log, init);
  monitor.tell([&](const host::RuntimeStatus& status) { figures.publish(status); });
  LineJournal journal(log);
  process::Heartbeat heartbeat(init);
  // A machine comes up whether its controller has power or not.
  init.ready("waits for the controller on " + where);
  // Who finds the socket finds a controller behind it.
  const bool found = find_controller(**runtime, journal, where, stop, [&] {
    figures.publish((*runtime)->figures());
    if (reload.take()) (void)monitor.reload();
    heartbeat.turn();
    log.tick();
  });
  if (!found) return to_int(ExitCode::Done);
  auto server = service::Server::create(
      {config.socket_path(), config.supervisor_lost_after, STEPWRIGHT_VERSION, &monitor}, **runtime);
  if (!server) return fail(server.error(), ExitCode::BadInput);
  monitor.attach(**server, **runtime);
  const std::string listens = "gateway of '" + config.name + "' listens on " + config.socket_path().string() +
                              " for the controller on " + where;
  log.info("listens", listens, {{"cell", config.name}, {"socket", config.socket_path().string()}});
  init.status(listens);
  while (!stop.came()) {
    (*server)->turn(service::kStatusPeriod, stop.descriptor());
    figures.publish((*runtime)->figures());
    if (reload.take()) (void)monitor.reload();
    monitor.turn();
    journal.look(**runtime, where);
  }
  init.stopping();
  log.info("ends", "gateway of '" + config.name + "' ends");
  return to_int(ExitCode::Done);
}

int run(const config::CellConfig& config) {
  if (!config.controller.remote()) {
    return fail(
        result::fail("C0564", {config.file.string(), 0, 0}, "the cell has no controller behind Modbus",
                     "[controller] kind = \"modbus-rtu\" or \"modbus-tcp\"; else `stepwright runtime`")
            .value(),
        ExitCode::BadInput);
  }
  const process::StopSignal stop;
  process::ReloadSignal reload;
  process::NotifySocket init;
  auto log = log::Logger::open("gateway", config.log);
  if (!log) return fail(log.error(), ExitCode::BadInput);
  return config.controller.loaded_by_hand ? run_by_hand(config, **log, stop, reload, init)
                                          : serve(config, **log, stop, reload, init);
}

}  // namespace
}  // namespace stepwright::gateway

int main(int argc, char** argv) {
  CLI::App app{"Serve a controller that is reached over Modbus only as a runtime", "stepwright gateway"};
  stepwright::config::CellOptions options;
  stepwright::config::add_cell_options(app, options);
  bool concerned = false;
  app.add_flag("--concerned", concerned,
               "only tell by the exit code whether this cell's program is for this process: 0 yes, 1 no");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  if (concerned) {
    return to_int(stepwright::config::concerned(
        options, [](const stepwright::config::CellConfig& cell) { return cell.controller.remote(); }));
  }
  const auto config = stepwright::config::load_cell(options);
  return config ? stepwright::gateway::run(*config) : config.error();
}

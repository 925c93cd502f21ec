// `stepwright gateway --config CELL.toml`: serves a controller that is reached over Modbus only as a runtime.
// It listens on the socket of the cell's runtime, so that link, supervisor, page and tools need to know
// nothing of it. SIGTERM ends it with the controller stopped.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "programs/config/cell_options.h"
#include "programs/gateway/controller_line.h"
#include "programs/gateway/follow_plan.h"
#include "programs/log/logger.h"
#include "programs/process/command_line.h"
#include "programs/process/notify_socket.h"
#include "programs/process/reload_signal.h"
#include "programs/process/stop_signal.h"
#include "programs/runtime/attendant.h"
#include "programs/runtime/cell_io.h"
#include "runtime/remote/remote_runtime.h"
#include "runtime/result/exit_code.h"
#include "runtime/service/server.h"

namespace stepwright::gateway {
namespace {

using process::fail;
using result::ExitCode;
using std::chrono::milliseconds;

constexpr milliseconds kLook{20};

result::Result<void> make_state_dir(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::create_directories(folder, error))
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all, error);
  if (!error) return {};
  return result::fail("R0001", {folder.string(), 0, 0},
                      "the state folder cannot be made: " + error.message());
}

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

int run(const config::CellConfig& config) {
  if (!config.controller.remote()) {
    return fail(
        result::fail("C0544", {config.file.string(), 0, 0}, "the cell has no controller behind Modbus",
                     "[controller] kind = \"modbus-rtu\" or \"modbus-tcp\"; else `stepwright runtime`")
            .value(),
        ExitCode::BadInput);
  }
  const process::StopSignal stop;
  process::ReloadSignal reload;
  process::NotifySocket init;
  auto opened = log::Logger::open("gateway", config.log);
  if (!opened) return fail(opened.error(), ExitCode::BadInput);
  log::Logger& log = **opened;
  if (config.controller.loaded_by_hand) {
    auto plan = read_hand_plan(config.controller.plan);
    if (!plan) return fail(plan.error(), ExitCode::BadInput);
    auto line = make_line(config.controller);
    if (!line) return fail(line.error(), ExitCode::BadInput);
    return to_int(follow_plan(config, *plan, **line, log, stop));
  }
  auto options = remote_options(config);
  if (!options) return fail(options.error(), ExitCode::BadInput);
  if (auto made = make_state_dir(config.state_dir); !made) return fail(made.error(), ExitCode::BadInput);
  auto io = cell_runtime::CellIo::create(config);
  if (!io) return fail(io.error(), ExitCode::BadInput);
  auto line = make_line(config.controller);
  if (!line) return fail(line.error(), ExitCode::BadInput);
  const std::string where = (*line)->name();

  auto runtime = remote::RemoteRuntime::create(*options, std::move(*line), (*io)->driver(), (*io)->plant());
  if (!runtime) return fail(runtime.error(), ExitCode::RuntimeFault);
  LineJournal journal(log);
  // Who finds the socket finds a controller behind it.
  while (!(*runtime)->wait_for_controller(kLook)) {
    if (stop.came()) return to_int(ExitCode::Done);
    journal.look(**runtime, where);
  }
  cell_runtime::Attendant attendant(config, log, init);
  auto server = service::Server::create(
      {config.socket_path(), config.supervisor_lost_after, STEPWRIGHT_VERSION, &attendant}, **runtime);
  if (!server) return fail(server.error(), ExitCode::BadInput);
  attendant.attach(**server, **runtime);
  const std::string listens = "gateway of '" + config.name + "' listens on " + config.socket_path().string() +
                              " for the controller on " + where;
  log.info("listens", listens, {{"cell", config.name}, {"socket", config.socket_path().string()}});
  init.ready(listens);
  while (!stop.came()) {
    (*server)->turn(service::kStatusPeriod, stop.descriptor());
    if (reload.take()) (void)attendant.reload();
    attendant.turn();
    journal.look(**runtime, where);
  }
  init.stopping();
  log.info("ends", "gateway of '" + config.name + "' ends");
  return to_int(ExitCode::Done);
}

}  // namespace
}  // namespace stepwright::gateway

int main(int argc, char** argv) {
  CLI::App app{"Serve a controller that is reached over Modbus only as a runtime", "stepwright gateway"};
  stepwright::config::CellOptions options;
  stepwright::config::add_cell_options(app, options);
  const auto config = stepwright::config::parse_cell(app, options, argc, argv);
  return config ? stepwright::gateway::run(*config) : config.error();
}

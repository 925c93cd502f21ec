// `stepwright supervisor --config CELL.toml`: plans the cell's problem, executes it on the runtime behind
// Fast DDS, and keeps the plan document up to date for viewers. A supervisor that is killed and started again
// goes on with the plan that runs.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include "programs/config/cell_options.h"
#include "programs/config/dds_options.h"
#include "programs/config/executive_options.h"
#include "programs/log/logger.h"
#include "programs/log/reload_log.h"
#include "programs/process/command_line.h"
#include "programs/process/notify_socket.h"
#include "programs/process/reload_signal.h"
#include "programs/supervisor/operator_request.h"
#include "runtime/dds/plan_channel.h"
#include "runtime/result/exit_code.h"
#include "supervisor/executive/dds_controller.h"
#include "supervisor/executive/report.h"

namespace stepwright {
namespace {

using process::fail;
using result::ExitCode;
using std::chrono::milliseconds;

void obey(executive::Executive& executive, const std::string& text, log::Logger& log) {
  const auto refuse = [&](const result::Diagnostics& why) {
    log.warning("refused", "operator request refused: " + result::to_string(why));
  };
  auto request = supervisor_program::parse_operator_request(text);
  if (!request) return refuse(request.error());
  if (std::holds_alternative<supervisor_program::AbortRequest>(*request)) return executive.request_abort();
  const auto& change = std::get<supervisor_program::ChangeRequest>(*request);
  if (auto changed = executive.request_change(change.fluent, change.value); !changed) refuse(changed.error());
}

// One line for each change of phase.
void narrate(const executive::RunRecord& record, std::string& last, log::Logger& log) {
  std::string line = std::string(to_string(record.phase)) + ": " + record.message;
  if (line == last) return;
  log.info("phase", line, {{"phase", to_string(record.phase)}});
  last = std::move(line);
}

// The status after the last scan: the plant is stopped, so its figures come to rest.
host::RuntimeStatus final_status(const executive::Controller& controller) {
  host::RuntimeStatus status;
  for (int i = 0; i < 200; ++i) {
    if (const auto now = controller.status()) status = *now;
    if (status.state != host::RuntimeState::Running && status.state != host::RuntimeState::Empty) break;
    std::this_thread::sleep_for(milliseconds(5));
  }
  return status;
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path fresh = file.string() + ".new";
  std::ofstream(fresh) << text;
  std::error_code ignored;  // a missing report is noticed by whoever waits for it
  std::filesystem::rename(fresh, file, ignored);
}

int run(const config::CellConfig& config, bool once) {
  if (config.planning.domain.empty()) {
    const auto missing = result::fail("C0005", {config.file.string(), 0, 0}, "there is no [planning] table",
                                      "name domain, problem and binding there");
    return fail(missing.value(), ExitCode::BadInput);
  }
  std::error_code error;
  std::filesystem::create_directories(config.state_dir, error);
  if (error) {
    const auto failed = result::fail("R0001", {config.state_dir.string(), 0, 0},
                                     "the state folder cannot be made: " + error.message());
    return fail(failed.value(), ExitCode::BadInput);
  }
  process::ReloadSignal reload;
  process::NotifySocket init;
  auto opened = log::Logger::open("supervisor", config.log);
  if (!opened) return fail(opened.error(), ExitCode::BadInput);
  log::Logger& log = **opened;
  auto desk = executive::PlanningDesk::open(config::desk_options(config));
  if (!desk) return fail(desk.error(), ExitCode::BadInput);
  const dds::ParticipantConfig participant = config::participant_of(config.dds, "supervisor");
  auto controller = executive::DdsController::connect(participant);
  if (!controller) return fail(controller.error(), ExitCode::RuntimeFault);
  auto publisher = dds::PlanPublisher::create(participant);
  if (!publisher) return fail(publisher.error(), ExitCode::RuntimeFault);

  std::string last_line;
  executive::Executive executive(*desk, **controller, config::executive_options(config),
                                 [&](const executive::RunRecord& record) {
                                   narrate(record, last_line, log);
                                   (void)(*publisher)->publish(to_json(record));  // viewers keep the last one
                                 });
  std::jthread requests([&](const std::stop_token& stop) {
    config::CellConfig running = config;
    while (!stop.stop_requested()) {
      if (auto request = (*publisher)->wait_request(milliseconds(200))) obey(executive, *request, log);
      if (reload.take()) log::reload_log(running, log, init);
      log.tick();
    }
  });
  init.ready("attends '" + config.dds.runtime_id + "'");
  const executive::RunRecord record = executive.run();
  const executive::Report report{record, final_status(**controller)};
  write_file(config.report_path(), executive::to_json(report));
  std::printf("%s", executive::report_table(record).c_str());
  std::fflush(stdout);
  init.status(to_string(record.phase));
  while (!once) std::this_thread::sleep_for(std::chrono::hours(1));  // viewers still want the document
  return to_int(record.exit);
}

}  // namespace
}  // namespace stepwright

int main(int argc, char** argv) {
  CLI::App app{"Plan, download, watch and replan", "stepwright supervisor"};
  stepwright::config::CellOptions options;
  bool once = false;
  stepwright::config::add_cell_options(app, options);
  app.add_flag("--once", once, "end with the run instead of keeping its result for viewers");
  const auto config = stepwright::config::parse_cell(app, options, argc, argv);
  return config ? stepwright::run(*config, once) : config.error();
}

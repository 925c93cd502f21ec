// `stepwright supervisor --config CELL.toml [--config OTHER.toml ...]`: plans the problem of each cell,
// executes it on the cell's runtime behind Fast DDS, and keeps the plan document up to date for viewers. A
// supervisor that is killed and started again goes on with the plans that run. Each cell has a thread of its
// own; what becomes of one does not concern the others.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <future>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "cell/config/cell_config.h"
#include "cell/config/cell_options.h"
#include "cell/config/dds_options.h"
#include "cell/config/reload_log.h"
#include "cell/config/state_dir.h"
#include "cell/missions/mission_kinds.h"
#include "cell/missions/watched_tags.h"
#include "runtime/dds/plan_channel.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/log/refused_samples.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/notify_socket.h"
#include "runtime/ground/process/reload_signal.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/ground/result/last_barrier.h"
#include "supervisor/run/dds_controller.h"
#include "supervisor/run/report.h"

namespace stepwright {
namespace {

using process::fail;
using result::ExitCode;
using std::chrono::milliseconds;

// Between two looks at what viewers should know of where a plan would begin.
constexpr milliseconds kLook{200};
// A runtime that is there answers within this time.
constexpr milliseconds kFirstLook{2'000};

// What the cells of one supervisor share.
struct Shared {
  log::Logger& log;
  process::NotifySocket& init;  // of one thread at a time: `telling`
  std::mutex telling{};
  std::size_t cells = 1;
  std::mutex joining{};  // Fast DDS gives two participants that are made at the same time the same number
  std::size_t attended = 0;

  // In front of what is said of one of several.
  std::string of(const config::CellConfig& config) const { return cells > 1 ? config.name + ": " : ""; }
};

result::Result<void> obey(run::Mission& mission, const std::string& text) {
  auto request = run::Request::parse(text);
  if (!request) return result::forward(request);
  return mission.obey(*request);
}

void answer(dds::PlanPublisher& publisher, const dds::OperatorRequest& request,
            const result::Result<void>& verdict, const std::string& cell, log::Logger& log) {
  if (!verdict)
    log.warning("refused", cell + "operator request refused: " + result::to_string(verdict.error()));
  // Who asked may be gone.
  (void)publisher.answer(request, verdict);
}

// One line for each change of phase.
void narrate(const run::RunRecord& record, std::string& last, const config::CellConfig& config,
             const Shared& shared) {
  std::string line = shared.of(config) + std::string(to_string(record.phase)) + ": " + record.message;
  if (line == last) return;
  shared.log.info("phase", line, {{"cell", config.name}, {"phase", to_string(record.phase)}});
  last = std::move(line);
}

// The status after the last scan: the plant is stopped, so its figures come to rest.
host::RuntimeStatus final_status(const run::Controller& controller) {
  host::RuntimeStatus status;
  for (int i = 0; i < 200; ++i) {
    if (const auto now = controller.status()) status = *now;
    if (status.state != host::RuntimeState::Running && status.state != host::RuntimeState::Empty) break;
    std::this_thread::sleep_for(milliseconds(5));
  }
  return status;
}

// Attends one cell. Returns when that cannot be done, or, with `once`, when its run is over.
int attend(const config::CellConfig& config, bool once, Shared& shared) {
  if (auto made = config::claim_state_dir(config); !made) return fail(made.error(), ExitCode::BadInput);
  auto planner = missions::open(config);
  if (!planner) return fail(planner.error(), ExitCode::BadInput);
  dds::ParticipantConfig participant = config::participant_of(config.dds, "supervisor");
  participant.on_trouble = log::refused_samples(shared.log);
  std::unique_lock joining(shared.joining);
  auto controller = run::DdsController::connect(participant);
  if (!controller) return fail(controller.error(), ExitCode::RuntimeFault);
  joining.unlock();
  // Before anybody hears of it: who has the runtime is not disturbed, nor those who look on.
  if ((*controller)->wait_for_runtime(kFirstLook)) {
    if (auto claimed = (*controller)->claim();
        !claimed && claimed.error().front().code == dds::kHeldByAnother)
      return fail(claimed.error(), ExitCode::RuntimeFault);
  }
  joining.lock();
  auto publisher = dds::PlanPublisher::create(participant);
  if (!publisher) return fail(publisher.error(), ExitCode::RuntimeFault);
  if (++shared.attended == shared.cells) {
    const std::lock_guard telling(shared.telling);
    shared.init.ready(shared.cells > 1 ? "attends " + std::to_string(shared.cells) + " cells"
                                       : "attends '" + config.dds.runtime_id + "'");
  }
  joining.unlock();

  std::string last_line;
  const auto mission = (*planner)->mission(**controller, [&](const run::RunRecord& record) {
    narrate(record, last_line, config, shared);
    (void)(*publisher)->publish(to_json(record));  // viewers keep the last one
  });
  mission->watch(missions::watched_tags(config));
  if (once) mission->only_once();
  (void)(*publisher)->publish_goal_form(mission->goal_form());
  std::jthread requests([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const auto thrown = result::thrown_by([&] {
        if (const auto request = (*publisher)->wait_request(kLook))
          answer(**publisher, *request, obey(*mission, request->text), shared.of(config), shared.log);
        if (const auto outlook = mission->new_outlook()) (void)(*publisher)->publish_outlook(*outlook);
        if (const auto pictures = mission->new_pictures()) (void)(*publisher)->publish_pictures(*pictures);
      });
      if (thrown) shared.log.error("requests", shared.of(config) + "a request failed: " + *thrown);
    }
  });
  while (true) {
    const run::RunRecord record = mission->run();
    const run::Report report{record, final_status(**controller)};
    const auto unwritten = files::write_file(config.report_path().string(), run::to_json(report));
    if (!unwritten.empty() && !once)
      shared.log.error("report", shared.of(config) + "there is no report: " + result::to_string(unwritten));
    std::printf("%s%s", shared.of(config).c_str(), run::report_table(record).c_str());
    std::fflush(stdout);
    {
      const std::lock_guard telling(shared.telling);
      shared.init.status(shared.of(config) + to_string(record.phase));
    }
    if (once && !unwritten.empty())
      return fail(unwritten, record.exit == ExitCode::Done ? ExitCode::RuntimeFault : record.exit);
    if (once) return to_int(record.exit);
    while (!mission->wait_start(std::chrono::seconds(1))) {  // viewers still want the document
    }
  }
}

// A sign of life of the process, whatever its cells plan: that takes as long as it takes. A mission that
// stands still is the runtime's to see.
void live_on(config::CellConfig& running, process::ReloadSignal& reload, process::Heartbeat& heartbeat,
             Shared& shared) {
  const std::lock_guard telling(shared.telling);
  if (reload.take()) config::reload_log(running, shared.log, shared.init);
  shared.log.tick();
  heartbeat.turn();
}

// Every cell that cannot be attended, before any is.
result::Diagnostics check(std::span<const config::CellConfig> cells) {
  result::Diagnostics problems;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const result::Location where{cells[i].file.string(), 0, 0};
    if (!cells[i].mission.table) {
      problems.push_back({"C0005", result::Severity::Error, where, "there is no table of a planner",
                          "one of " + missions::mission_tables()});
    }
    for (std::size_t j = 0; j < i; ++j) {
      const bool same = cells[i].dds.runtime_id == cells[j].dds.runtime_id &&
                        cells[i].dds.domain_id == cells[j].dds.domain_id;
      if (!same) continue;
      problems.push_back({"C0467", result::Severity::Error, where,
                          "this is the runtime of " + cells[j].file.string() + " again",
                          "each cell of a supervisor has a runtime_id of its own"});
    }
  }
  return problems;
}

int run_cells(const std::vector<config::CellConfig>& cells, bool once) {
  if (const auto problems = check(cells); !problems.empty()) return fail(problems, ExitCode::BadInput);
  process::ReloadSignal reload;
  process::NotifySocket init;
  auto opened = log::Logger::open("supervisor", cells.front().log);
  if (!opened) return fail(opened.error(), ExitCode::BadInput);
  Shared shared{**opened, init, {}, cells.size()};
  process::Heartbeat heartbeat(init);
  std::vector<std::future<int>> runs;
  for (const config::CellConfig& cell : cells)
    runs.push_back(std::async(std::launch::async, [&] { return attend(cell, once, shared); }));
  config::CellConfig running = cells.front();
  int exit = to_int(ExitCode::Done);
  for (std::future<int>& each : runs) {
    while (each.wait_for(milliseconds(200)) != std::future_status::ready)
      live_on(running, reload, heartbeat, shared);
    if (exit == 0) exit = each.get();
  }
  return exit;
}

}  // namespace
}  // namespace stepwright

int main(int argc, char** argv) {
  namespace config = stepwright::config;
  CLI::App app{"Plan, download, watch and replan", "stepwright supervisor"};
  std::vector<std::string> files;
  std::vector<std::string> overrides;
  bool once = false;
  app.add_option("--config", files, "configuration file of a cell; may be repeated")
      ->required()
      ->allow_extra_args(false);
  app.add_option("--set", overrides, "KEY=VALUE that wins over the files, e.g. plant.seed=7");
  app.add_flag("--once", once, "end with the runs instead of keeping their results for viewers");
  bool concerned = false;
  app.add_flag("--concerned", concerned,
               "only tell by the exit code whether the first cell has a planner: 0 yes, 1 no");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  if (concerned) {
    return to_int(config::concerned({files.front(), overrides}, [](const config::CellConfig& cell) {
      return cell.mission.table != nullptr;
    }));
  }
  std::vector<config::CellConfig> cells;
  for (const std::string& file : files) {
    auto cell = config::load_cell_config(file, overrides);
    if (!cell) return stepwright::process::fail(cell.error(), stepwright::result::ExitCode::BadInput);
    cells.push_back(std::move(*cell));
  }
  return stepwright::run_cells(cells, once);
}
